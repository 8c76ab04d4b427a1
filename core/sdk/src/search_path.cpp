#include <foam/sdk/registry.hpp>
#include <foam/sdk/sdk.hpp>

#include <cstdlib>
#include <sstream>

namespace foam::inline sdk {

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

} // namespace foam::sdk
