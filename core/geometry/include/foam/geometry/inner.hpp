// Proof that spheres lie in a solid: the basis of the guarantee `inner`. Symbols as in measure.hpp.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// The result of the proof that every sphere lies in the solid.
struct InnerCertificate {
    bool holds = false;
    std::size_t sphere = 0; ///< if it does not hold: the one that protrudes farthest
    double excess = 0;      ///< m; if it does not hold: by how much its radius exceeds the proved radius
};

/// Returns, for each sphere, the largest radius, at most its own, with which it is proved to lie in one part of the
/// solid; 0 if there is none. A ball lies in a part if no triangle is nearer to its centre than its radius and the
/// winding number at the centre is above one half. Near the rim of an open mesh, the winding number changes smoothly.
/// There it must stay above one half over the whole ball, which is proved from its gradient. Rounding is on the safe
/// side. A ball that only the union of overlapping parts contains is not proved. O(triangles) per sphere.
std::vector<double> inner_radii(const Solid& solid, std::span<const Sphere> spheres);

/// Proves that no radius is above its inner radius. The certificate holds if there are no spheres, and fails for
/// spheres that are not finite.
InnerCertificate certify_inner(const Solid& solid, std::span<const Sphere> spheres);

/// Returns the spheres shrunk to their inner radii. A sphere whose centre is outside first moves to a deep point of the
/// solid within its radius, if one is found. A sphere that finds no room, or lies in another, ends with radius 0. No
/// sphere becomes larger.
std::vector<Sphere> shrunk_to_fit(const Solid& solid, std::vector<Sphere> spheres);

} // namespace geometry
} // namespace foam
