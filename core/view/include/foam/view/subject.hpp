// What `foam view` shows: robots with their meshes and colours, and sphere models of them.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/recipe/mesh_unit.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/registry.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] view {

/// A colour: 0xRRGGBBAA.
using Colour = std::uint32_t;

struct ViewedMesh {
    std::shared_ptr<const Mesh> mesh; ///< in the frame of its element, scaled, m
    std::vector<Colour> colours;      ///< of each triangle; empty: the file has none
};

/// A <visual> or <collision> of a link.
struct ViewedElement {
    std::shared_ptr<const ViewedMesh> mesh;
    Pose pose;                    ///< from its frame to the link's
    std::optional<Colour> colour; ///< of its <material>
};

struct ViewedLink {
    std::vector<ViewedElement> visuals, collisions;
    bool judged = false; ///< it has geometry by which spheres are judged
};

/// A configuration with a name.
struct NamedPose {
    std::string name;
    std::vector<double> configuration; ///< of each freedom, rad or m
};

struct ViewedRobot {
    std::filesystem::path file; ///< empty: only the names of links are known, from a sphere model
    std::shared_ptr<const Robot> robot;
    std::shared_ptr<const Kinematics> kinematics;
    std::vector<ViewedLink> links; ///< of each link of the robot
    std::vector<NamedPose> poses;  ///< the first is the one that is shown
    bool judged = false;           ///< one of its links is: the geometry is known, and is not spheres itself
    std::shared_ptr<const LoadedInput> loaded{}; ///< what was read, with the meshes; null: no file
};

/// A sphere model of a robot.
struct ViewedModel {
    std::filesystem::path file;               ///< empty: it is made in the session
    std::string format;                       ///< of the file
    std::size_t robot = 0;                    ///< index into Subject::robots
    std::vector<std::vector<Sphere>> spheres; ///< of each link of the robot, in its frame
};

struct Subject {
    std::vector<ViewedRobot> robots;
    std::vector<ViewedModel> models; ///< at least one; without spheres if only a robot was given
    std::vector<std::string> notes;  ///< warnings for people
};

struct SubjectOptions {
    std::vector<std::filesystem::path> files; ///< robots, meshes, and sphere models of the robot before them
    Renames renames{};
    std::string reader{}; ///< of sphere models; empty: the one that recognises them
    MeshUnit unit{};
    std::vector<std::filesystem::path> package_path{}; ///< before those of the environment
    CoveredGeometry geometry = CoveredGeometry::collision; ///< by which spheres are judged
    std::filesystem::path srdf{};                          ///< with named poses; empty: none
    std::filesystem::path nameless{}; ///< of `files`, the one that holds the standard input; empty: none
    /// The name that its content goes by: relative references lead from its folder.
    std::filesystem::path nameless_name{};
    RobotChoices choices{}; ///< of the robots; tool_frames play no part
};

/// Reads the files. The first is a URDF, a mesh or a sphere model; a later one is a sphere model of the robot before
/// it, or another robot. A URDF with spheres as its only collision geometry is a sphere model of itself. Throws
/// Error(input) for a file that cannot be read; a mesh that cannot is left out, with a note.
Subject load_subject(const SubjectOptions& options, const Registry& registry);

/// Returns the files that a page shows: those of the options, and the meshes of the robots.
std::vector<std::filesystem::path> inputs_of(const Subject& subject, const SubjectOptions& options);

/// Returns the original geometry by which the spheres of a robot are judged. Precondition: robot.judged.
Original original_of(const ViewedRobot& robot, const SubjectOptions& options, const Registry& registry);

} // namespace view
} // namespace foam
