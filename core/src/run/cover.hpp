// What the guarantee asks of a spherizer's spheres, and the numbers that are written.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <memory>
#include <vector>

namespace foam {

/// Volume that the spheres claim wrongly once the guarantee is kept, m³: outer: that of the grown ones outside the
/// solid; inner: what the shrunk ones miss; fitted: excess plus missing. What spheres leave out is found along lines
/// that are the same for all spheres of a solid.
double wrong_volume(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);

/// Largest distance of the exposed surface of the spheres from the solid, once the guarantee is kept, m.
double covered_protrusion(const Solid& solid, std::vector<Sphere> spheres, Guarantee guarantee);

/// Throws Error(geometry) if no sphere of the finest level can lie in the solid: guarantee inner cannot be kept.
void require_room(const Solid& solid, const SphereTree& tree);

struct FinishedTree {
    SphereTree tree;
    double growth = 0;         ///< m; largest growth of a radius of the finest level
    bool one_instead = false; ///< one sphere stands in for others that would claim more
};

/// The tree with numbers fit for a file: centres on a decimal grid of about a millionth of the solid's size; outer:
/// radii grown so that every level covers, and rounded up on the same grid; inner: radii shrunk so that every level
/// lies in the solid, and rounded down, spheres that find no room left out. Throws Error(geometry) if none is left.
FinishedTree finished_tree(const Solid& solid, SphereTree tree, Guarantee guarantee, bool one_may_do = true);

} // namespace foam
