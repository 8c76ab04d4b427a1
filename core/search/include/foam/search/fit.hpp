// Spheres with a small symmetric difference to a solid: guarantee fitted.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {
namespace fitted {

/// Revision of the method. Raise it when the same input gives other spheres: old cache entries are then ignored.
constexpr int revision = 3;

/// How far the search goes from its start.
enum class Reach {
    near, ///< descent only: every sphere stays near its start
    far,  ///< also other starts of as many spheres, and moves of spheres that contribute little to where much is
          ///< missing
};

/// Returns spheres moved and sized so that vol(U \ S) + vol(S \ U) is small; `start` itself if nothing better is found,
/// or if the solid encloses no volume. As many as at the start or, with Reach::far, up to `most`. Deterministic.
std::vector<Sphere> fit(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach);

} // namespace fitted
} // namespace search
} // namespace foam
