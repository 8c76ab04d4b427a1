// Spheres that lie in a solid, proved: what the guarantee `inner` rests on. Symbols as in measure.hpp.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace foam {

/// A proof that every sphere lies in the solid, or what stands in its way.
struct InnerCertificate {
    bool holds = false;
    std::size_t sphere = 0; ///< if it does not hold: the one that sticks out farthest
    double excess = 0;      ///< m; if it does not hold: by how much its radius is above what is proved
};

/// For each sphere the largest radius, at most its own, with which it is proved to lie in one part of the solid; 0 if
/// there is none. A ball lies in a part if no triangle comes nearer to its centre than its radius and the winding
/// number at the centre is above one half; near the rim of an open mesh, where the winding number falls smoothly, it
/// must stay above one half over the whole ball, which is proved from its gradient. Rounding is on the safe side. A
/// ball that only the union of overlapping parts holds is not proved. O(triangles) a sphere.
std::vector<double> inner_radii(const Solid& solid, std::span<const Sphere> spheres);

/// Proves that no radius is above its inner radius. No spheres: holds. Spheres that are not finite do not pass.
InnerCertificate certify_inner(const Solid& solid, std::span<const Sphere> spheres);

/// Spheres shrunk to their inner radii. One whose centre is outside first moves to a deep point of the solid within its
/// reach, if one is found. A sphere that finds no room, or lies in another, ends with radius 0; no sphere becomes
/// larger.
std::vector<Sphere> shrunk_to_fit(const Solid& solid, std::vector<Sphere> spheres);

} // namespace foam
