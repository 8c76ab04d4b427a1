// The robot in words of no format: links, joints, geometry, and what writers ask for. A loader fills all of it.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

/// A mesh that a robot refers to.
struct MeshReference {
    std::string uri;            ///< as written
    std::filesystem::path path; ///< resolved; empty where the mesh stands in the robot's own text
    Vec3 scale{1, 1, 1};        ///< applied to the mesh before the origin
    /// What the format makes of the file, such as its convex hull, or a mesh of the robot's own text; null: the mesh of
    /// the file.
    std::shared_ptr<const Mesh> mesh{};
    std::string problem{}; ///< why there is no path, with file, line, places and remedy; who needs the mesh refuses it
};

using Geometry = std::variant<Element, MeshReference>;

/// What a surface looks like. A name that the file explains elsewhere is resolved.
struct Material {
    std::string name;
    std::optional<std::array<double, 4>> rgba; ///< as written, usually 0 to 1
    std::string texture;                       ///< URI as written, or empty
};

/// One element of collision or visual geometry.
struct GeometryElement {
    Pose origin;
    Geometry geometry;
    std::string name; ///< the element's name attribute, or empty
    int line = 0;     ///< 1-based line of the element in the source text
    std::shared_ptr<const Material> material{}; ///< of a visual; null if it has none
};

/// The mass of a link, as written. Only some writers need it, so `problem` keeps what they refuse it for.
struct Inertial {
    std::optional<double> mass;                   ///< kg
    std::optional<std::array<double, 6>> moments; ///< xx, yy, zz, xy, xz, yz about the centre, kg m², in their own axes
    Pose origin;                                  ///< the centre, and the axes of the moments, in the link's frame
    std::string problem{}; ///< why the numbers cannot be read, with file and line; empty if they can
    int line = 0;
};

struct Link {
    std::string name;
    std::vector<GeometryElement> collisions;
    std::vector<GeometryElement> visuals;
    std::optional<Inertial> inertial{};
};

/// A joint's value follows that of another: offset + multiplier · value.
struct Mimic {
    std::string joint;
    double multiplier = 1, offset = 0;
    std::string problem{}; ///< why it cannot be read, with file and line; empty if it can. Kinematics refuses it
};

struct Joint {
    enum class Kind { fixed, revolute, continuous, prismatic, planar, floating };
    std::string name;
    Kind kind = Kind::fixed;
    std::string parent, child; ///< link names
    Pose origin;
    Vec3 axis{1, 0, 0};          ///< unit, in the joint's frame
    double lower = 0, upper = 0; ///< rad or m; meaningful for revolute and prismatic
    bool limited = true;         ///< whether `lower` and `upper` are stated
    std::optional<Mimic> mimic{};
    std::optional<double> effort{}, velocity{};  ///< limits: N or N m, m/s or rad/s; none if not stated
    std::optional<double> damping{}, friction{}; ///< none if not stated
    int line = 0;                                ///< 1-based line in the source text; 0: of no text
};

/// Where a robot stands in the stage of USD that it was read from. Paths are those of prims.
struct StageOfRobot {
    struct Place {
        std::string path;
        /// Takes points of the link, in metres, to those of the prim: rows of a matrix for row vectors.
        std::array<double, 16> from_metres{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        std::vector<std::string> colliders{}; ///< prims with the link's collision geometry
    };
    std::map<std::string, Place> links;    ///< by name
    std::vector<std::string> instances;    ///< prims whose contents are shared with others
    std::string default_prim;              ///< its name; empty: none
    std::string up_axis = "Z";
    double metres_per_unit = 1;
};

struct Robot {
    std::string name;
    std::string root;           ///< name of the root link
    std::vector<Link> links;    ///< in the order of the source
    std::vector<Joint> joints;  ///< in the order of the source
    /// What it was read from: relative references lead from its folder. It need not exist; empty: none.
    std::filesystem::path file;
    /// The text of the URDF that it was read from, unchanged, for write.urdf, which edits it; empty: write.urdf composes
    /// one. Nobody else reads it.
    std::string source;
    /// Files that it was read from beside its own, sorted: included ones, and meshes whose hulls it has.
    std::vector<std::filesystem::path> further_files{};
    std::shared_ptr<const StageOfRobot> stage{}; ///< null: it was not read from USD

    /// Returns the link; nullptr if no link has that name.
    const Link* find_link(const std::string& link) const;
};

/// Returns the tips: the links that no joint moves another link from, in the order of the source.
std::vector<std::string> tips_of(const Robot& robot);

/// Returns the files that the robot's own leads to: Robot::further_files, and those of its meshes, collision geometry and
/// visuals.
std::vector<std::filesystem::path> files_beside(const Robot& robot);

/// Joint values by name (rad or m). Unnamed joints stay at zero, moved into their limits.
using JointValues = std::map<std::string, double>;
/// Returns the pose of every link in the root link's frame, by link name. Links that the root does not reach are left
/// out. Given values are used unchanged; planar, floating and fixed joints stay at their origin. Throws Error(usage)
/// for a value of a joint that the robot does not have.
std::map<std::string, Pose> link_poses(const Robot& robot, const JointValues& values = {});

/// What of a link is to be covered. `collision_or_visual`: its collision geometry, or its visual geometry if it has none.
enum class CoveredGeometry { collision, visual, both, collision_or_visual };

/// Returns the words in recipes and options, in the order of the enumeration: collision, visual, both,
/// collision-or-visual.
const std::vector<std::string>& words_of_covered_geometry();
/// Returns "collision geometry", "visual geometry", "collision and visual geometry" or "collision or visual geometry".
const char* to_string(CoveredGeometry geometry);

/// Returns the robot with the geometry to be covered in place of its collision geometry. An element that is both
/// collision and visual geometry occurs once. The source text stays as it is.
Robot with_covered_geometry(Robot robot, CoveredGeometry geometry);

/// Returns the names of the links that have collision geometry, but none of the kind to be covered.
std::vector<std::string> uncovered_links(const Robot& robot, CoveredGeometry geometry);

/// What formats state of a robot beyond its URDF: keys of a recipe's `robot`, the same for all writers.
struct RobotFacts {
    std::string base_link;                ///< empty: the root link
    std::vector<std::string> tool_frames; ///< links
    JointValues lock_joints;              ///< joints that a planner is to hold, and their positions; rad or m
    JointValues default_pose;             ///< rad or m; joints that are not named: zero, moved into the limits
    std::optional<double> acceleration;   ///< of every joint, rad/s² or m/s²
    std::optional<double> jerk;           ///< of every joint, rad/s³ or m/s³

    bool operator==(const RobotFacts&) const = default;
};

/// Two links that are left out of self-collision checks.
struct IgnoredPair {
    std::string first, second;
    std::string reason; ///< in the words of SRDFs: "Adjacent", "Never", …; may be empty
};

/// A pose with a name, of some joints of a robot: a <group_state>, or a <key>.
struct GroupState {
    std::string name;
    JointValues values; ///< rad or m
};

/// Returns the <group_state> elements of an SRDF, or the keyframes of an MJCF, in their order, without joints of several
/// freedoms; nothing for a text of another format. Throws Error(input) naming file and line for a joint without a name or a position.
std::vector<GroupState> group_states(const std::string& text, const std::string& file);

} // namespace robot
} // namespace foam
