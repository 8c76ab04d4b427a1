#include <foam/sdk/sdk.hpp>

#include <foam/base/error.hpp>

#include <fmt/format.h>

#include <dlfcn.h>

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

} // namespace foam::sdk
