#include <foam/sdk/sdk.hpp>

#include <foam/base/error.hpp>
#include <foam/sdk/registry.hpp>

#include <fmt/format.h>

#include <dlfcn.h>

#include <cstdlib>
#include <sstream>

namespace foam::inline sdk {

namespace fs = std::filesystem;

fs::path library_folder() {
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&library_folder), &info) == 0 || !info.dli_fname) {
        throw Error(ErrorCode::internal, "the dynamic linker does not know where foam's library is");
    }
    return fs::weakly_canonical(info.dli_fname).parent_path();
}

fs::path installation_prefix() {
    const fs::path libraries = library_folder();
    // <prefix>/lib, or <prefix>/lib/<architecture> as on Debian.
    const fs::path above = libraries.parent_path();
    return libraries.filename() != "lib" && above.filename() == "lib" ? above.parent_path() : above;
}

fs::path sdk_prefix() {
    const fs::path package = library_folder() / "cmake" / "foam" / "foamConfig.cmake";
    if (!fs::exists(package)) {
        throw Error(ErrorCode::usage,
                    fmt::format("the SDK is not installed: there is no {}; remedy: install the package foam-dev, or "
                                "`cmake --install` with the component sdk",
                                package.string()));
    }
    return installation_prefix();
}

std::vector<std::filesystem::path> plugin_directories(const std::vector<std::filesystem::path>& extra) {
    std::vector<std::filesystem::path> directories = extra;
    if (const char* path = std::getenv("FOAM_PLUGIN_PATH")) {
        std::istringstream stream(path);
        for (std::string entry; std::getline(stream, entry, ':');) {
            // An empty or relative entry would mean the current directory, which is never searched.
            if (std::filesystem::path(entry).is_absolute()) {
                directories.emplace_back(entry);
            }
        }
    }
    // The same in the build tree and when installed.
    directories.push_back(library_folder() / FOAM_PLUGIN_SUBDIRECTORY);
    return directories;
}

} // namespace foam::inline sdk
