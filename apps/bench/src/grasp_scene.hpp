// A robot, a plane and an object to grasp, in MuJoCo's format (MJCF).
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/robot/kinematics.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace foam::inline bench::experiment {

/// What collides of a link: spheres, or the convex hulls of the parts of its solid, as MuJoCo takes meshes.
struct GraspLink {
    std::shared_ptr<const Solid> solid; ///< null: no collision geometry; else mass and inertia are its, in any model
    std::vector<Sphere> spheres;        ///< empty: the solid collides
};

/// A box that stands on the plane z = 0 of the robot's root, its edges along the axes.
struct GraspObject {
    Vec3 size{0.03, 0.03, 0.1}; ///< m
    Vec3 position{0.5, 0, 0};   ///< m; of the middle of its bottom face
    double mass = 0.1;          ///< kg
};

/// Indices into robot.links.
using LinkPairs = std::vector<std::pair<std::size_t, std::size_t>>;

struct GraspScene {
    std::string text; ///< MJCF; the object's body is called "object", links have their names
    /// Joints in the order of the controls and of the positions, before the object's seven; indices into robot.joints.
    std::vector<std::size_t> joints;
    Vec3 object; ///< where its centre is at the beginning, m
};

/// What a scene needs beside the robot. Links by their indices.
struct GraspSetup {
    GraspObject object{};
    LinkPairs excluded{};                      ///< pairs of links that are not checked against each other
    std::vector<std::size_t> object_ignores{}; ///< links that do not collide with the object
    std::vector<std::size_t> fingers{};        ///< the joints above them press with the force of a gripper
    double timestep = 0.004;                   ///< s
};

/// `links`: of each link of the robot.
GraspScene grasp_scene(const Kinematics& kinematics, const std::vector<GraspLink>& links, const GraspSetup& setup);

} // namespace foam::bench::experiment
