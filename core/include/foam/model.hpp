// A robot made of spheres: what writers get.
#pragma once

#include <foam/measure.hpp>
#include <foam/robot.hpp>
#include <foam/sphere.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace foam {

/// The spheres of one link, or of one collision element of it (recipe: `per: collision`). Link frame, metres.
struct SphereGroup {
    std::string link;
    /// What it stands for: the mesh references of the elements ("meshes/link0.stl") or the primitive's kind ("box").
    std::vector<std::string> geometries;
    /// Coarse to fine, as written: grown to cover if the guarantee is outer. tree.finest() are the link's spheres.
    SphereTree tree;
    /// Of the finest level.
    Measures measures;
};

struct SphereModel {
    std::string name; ///< of the recipe
    Guarantee guarantee = Guarantee::outer;
    std::shared_ptr<const Robot> robot;
    std::vector<SphereGroup> groups; ///< in the order of the robot's links
    /// The folder that the file being written will lie in, absolute; empty: not known. It need not exist yet.
    std::filesystem::path folder{};
};

/// The spheres of one link, over all its groups.
struct LinkSpheres {
    std::string link;
    std::vector<Sphere> spheres;
};

/// What a format without groups or trees holds of a model: its links in the order of their first groups. `level`: 0 the
/// coarsest, 1 the next…; -1, or one that a tree does not reach, stands for the finest of that tree. Throws
/// Error(output) for a group without spheres, and for a sphere that no reader would take: not finite, or of a radius
/// not above 0.
std::vector<LinkSpheres> spheres_by_link(const SphereModel& model, int level = -1);
/// The same refusals for all levels, for writers of whole trees.
void require_writable(const SphereModel& model);

} // namespace foam
