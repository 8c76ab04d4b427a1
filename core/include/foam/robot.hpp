// The robot as its URDF describes it: links, joints, collision elements, and the source text.
#pragma once

#include <foam/mesh.hpp>
#include <foam/vector.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace foam {

/// An exact solid, centred at its origin; cylinder and capsule along z. Metres.
struct Primitive {
    enum class Kind { box, sphere, cylinder, capsule };
    Kind kind = Kind::sphere;
    Vec3 size{};       ///< box: edge lengths
    double radius = 0; ///< sphere, cylinder, capsule
    double length = 0; ///< cylinder: height; capsule: height of the cylindrical part, without the caps

    bool operator==(const Primitive&) const = default;
};

const char* to_string(Primitive::Kind kind);

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

/// Joint values by name (rad or m). Unnamed joints stay at zero, moved into their limits.
using JointValues = std::map<std::string, double>;
/// Returns the pose of every link in the root link's frame, by link name. Links that the root does not reach are left
/// out. Given values are used unchanged; planar, floating and fixed joints stay at their origin. Throws Error(usage)
/// for a value of a joint that the robot does not have.
std::map<std::string, Pose> link_poses(const Robot& robot, const JointValues& values = {});

/// Returns a closed, outward oriented mesh that encloses the primitive (round parts circumscribed), in its own frame.
/// `segments`: around the circle, at least 3. A box is exact.
Mesh enclosing_mesh(const Primitive& primitive, int segments = 48);

} // namespace foam
