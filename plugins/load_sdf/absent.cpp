// load.sdf where libsdformat was not there when foam was built.
#include "model.hpp"

#include <foam/base/error.hpp>

#include <fmt/format.h>

namespace foam::load_sdf {

Robot robot_of(const std::string&, const std::filesystem::path& file, const ResourceResolver&, const MeshLoader*,
               Context&) {
    throw Error(ErrorCode::plugin,
                fmt::format("{}: this is SDF, and foam was built without libsdformat 12, which reads it; remedy: install "
                            "libsdformat-dev (Debian 12) and build foam again, or convert the file to URDF or MJCF",
                            file.string()));
}

} // namespace foam::load_sdf
