// load.sdf where libsdformat was there when foam was built: opens the library that reads by it.
#include "entry.hpp"

#include <foam/sdk/late_library.hpp>

namespace foam::load_sdf {

static RobotOf reader() {
    const LateLibrary library{.stage = "load.sdf",
                              .file = reader_file,
                              .entry = reader_entry,
                              .cure = "install libsdformat12 (Debian 12), or convert the file to URDF or MJCF"};
    return reinterpret_cast<EntryOfReader>(open_late_library(library, reinterpret_cast<const void*>(&reader)))();
}

Robot robot_of(const std::string& text, const std::filesystem::path& file, const ResourceResolver& resources,
               const MeshLoader* meshes, Context& context) {
    static const RobotOf read = reader();
    return read(text, file, resources, meshes, context);
}

} // namespace foam::load_sdf
