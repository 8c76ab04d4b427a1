// Sphere models in the file formats of many programs.
#pragma once

#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// The spheres of a file, by link. Metres; link frame.
struct SphereFile {
    std::filesystem::path file;
    std::string format;             ///< "URDF", "cuRobo YAML", "GPMP2 rows", …
    std::vector<LinkSpheres> links; ///< in the order of the file; a format without link names has one called ""
    /// URDF: joints that do not move, by the name of the child link. A link that only carries spheres of its parent
    /// (MorphIt) can be merged into the parent with them.
    struct FixedJoint {
        std::string parent;
        Pose origin; ///< from the child's frame to the parent's
    };
    std::map<std::string, FixedJoint> fixed_joints;
    std::vector<std::string> notes; ///< what was left out, and what the spheres alone do not state
};

/// Reads a sphere model; its content determines the format. Spheres whose radius is not above 0 are switched off
/// (cuMotion): they are left out, with a note. `registry`: for URDF, and for the formats of foam's writers. Throws
/// Error(input) naming file, line and remedy.
SphereFile read_sphere_file(const std::filesystem::path& file, const Registry& registry);

/// Reads a sphere model from memory; `file`: its name in messages, and the base of a URDF's references.
SphereFile parse_sphere_file(const std::string& text, const std::filesystem::path& file, const Registry& registry);

} // namespace judge
} // namespace foam
