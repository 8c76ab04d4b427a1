#include <foam/host/registry.hpp>

#include <dlfcn.h>

#include <cstdlib>
#include <sstream>

namespace foam {

std::vector<std::filesystem::path> plugin_directories(const std::vector<std::filesystem::path>& extra) {
    std::vector<std::filesystem::path> directories = extra;
    if (const char* path = std::getenv("FOAM_PLUGIN_PATH")) {
        std::istringstream stream(path);
        for (std::string entry; std::getline(stream, entry, ':');) {
            // An empty or relative entry would mean the current directory: never.
            if (std::filesystem::path(entry).is_absolute()) {
                directories.emplace_back(entry);
            }
        }
    }
    // The plugins lie beside libfoam-core.so, in the build tree as when installed.
    Dl_info info{};
    if (dladdr(reinterpret_cast<void*>(&plugin_directories), &info) && info.dli_fname) {
        const auto library = std::filesystem::weakly_canonical(info.dli_fname);
        directories.push_back(library.parent_path() / FOAM_PLUGIN_SUBDIRECTORY);
    }
    return directories;
}

} // namespace foam
