// Makes spheres of a spherizer keep the guarantee, and gives them the numbers that are written.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/recipe/recipe.hpp>

#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the volume that the guarantee aims to minimise, once it is kept, m³. Outer: excess volume of the grown
/// spheres. Inner: missing volume of the shrunk spheres. Fitted: symmetric difference. Missing volume is sampled along
/// lines that are the same for all spheres of a solid.
double cost_volume(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);
/// Returns the same for elements of any kind. Precondition: spheres alone with guarantee inner.
double cost_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee);

/// Returns the protrusion once the guarantee is kept, m: the largest distance of the exposed surface from the solid.
double covered_protrusion(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);
/// Returns the same for elements of any kind.
double protrusion_of_elements(const Solid& solid, const Elements& elements, Guarantee guarantee);

/// Throws Error(geometry) if no sphere of the finest level can lie in the solid: guarantee inner cannot be kept.
void require_room(const Solid& solid, const SphereTree& tree);

struct FinishedTree {
    SphereTree tree;
    double growth = 0;        ///< m; largest growth of a radius of the finest level
    bool one_instead = false; ///< one enclosing sphere replaces spheres with more excess volume
};

/// Returns the tree with the numbers of a file: centres on a decimal grid of about a millionth of the solid's size.
/// Outer: radii grow so that every level covers the solid, and are rounded up on the same grid. Inner: radii shrink so
/// that every level lies in the solid, and are rounded down; spheres that do not fit are left out. Throws
/// Error(geometry) if none remains. `one_may_do`: one enclosing sphere may replace spheres with more excess volume.
/// Elements of other kinds: half lengths as radii; the vertices of a hull lie on the grid in the link's frame. Lengths
/// are rounded up by a little more than readers of orientations lose (1e-12 of the distances). Precondition: spheres
/// alone with guarantee inner.
FinishedTree finished_tree(const Solid& solid, SphereTree tree, Guarantee guarantee, bool one_may_do = true,
                           Numbers numbers = Numbers::float64);

/// Returns the tree of spheres that cover what kept spheres leave of the solid, grown by the rounding of its pieces: beside
/// the kept ones it covers the solid.
SphereTree beside_kept(const Solid& solid, SphereTree others);

/// Returns the tree with all elements grown by `length`, m; radii and half lengths are rounded up on the same grid.
SphereTree padded(const Solid& solid, SphereTree tree, double length);

} // namespace runtime
} // namespace foam
