// The robot as its URDF describes it: links, joints, collision elements, and the source text.
#pragma once

#include <foam/geometry/primitive.hpp>
#include <foam/geometry/vector.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// A mesh file that a URDF refers to.
struct MeshReference {
    std::string uri;            ///< as written
    std::filesystem::path path; ///< resolved
    Vec3 scale{1, 1, 1};        ///< applied to the mesh before the origin
};

using Geometry = std::variant<Primitive, MeshReference>;

/// One <collision> or <visual> element.
struct GeometryElement {
    Pose origin;
    Geometry geometry;
    std::string name; ///< the element's name attribute, or empty
    int line = 0;     ///< 1-based line of the element in the source text
};

struct Link {
    std::string name;
    std::vector<GeometryElement> collisions;
    std::vector<GeometryElement> visuals;
};

struct Joint {
    enum class Kind { fixed, revolute, continuous, prismatic, planar, floating };
    std::string name;
    Kind kind = Kind::fixed;
    std::string parent, child; ///< link names
    Pose origin;
    Vec3 axis{1, 0, 0};          ///< unit, in the joint's frame
    double lower = 0, upper = 0; ///< rad or m; meaningful for revolute and prismatic
};

struct Robot {
    std::string name;
    std::string root;           ///< name of the root link
    std::vector<Link> links;    ///< in the order of the source
    std::vector<Joint> joints;  ///< in the order of the source
    std::filesystem::path file; ///< where it was read from
    std::string source;         ///< the XML text, unchanged: writers edit it and keep what they do not understand

    /// Returns the link; nullptr if no link has that name.
    const Link* find_link(const std::string& link) const;
};

/// Returns the files of the robot's meshes, collision geometry and visuals.
std::vector<std::filesystem::path> mesh_files(const Robot& robot);

/// Joint values by name (rad or m). Unnamed joints stay at zero, moved into their limits.
using JointValues = std::map<std::string, double>;
/// Returns the pose of every link in the root link's frame, by link name. Links that the root does not reach are left
/// out. Given values are used unchanged; planar, floating and fixed joints stay at their origin. Throws Error(usage)
/// for a value of a joint that the robot does not have.
std::map<std::string, Pose> link_poses(const Robot& robot, const JointValues& values = {});

} // namespace robot
} // namespace foam
