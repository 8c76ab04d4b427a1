// Spheres that claim little outside a solid and leave little of it out: guarantee fitted.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <span>
#include <vector>

namespace foam::fitted {

/// Raise it when the same input gives other spheres: old cache entries are then left.
constexpr int revision = 3;

/// How far the search goes from where it starts.
enum class Reach {
    near, ///< downhill alone: every sphere stays what it was one of
    far,  ///< other starts of as many spheres too, and spheres that are of little use put where much is missing
};

/// Spheres moved and sized so that vol(U \ S) + vol(S \ U) is small; `start` itself if nothing better is found, or if
/// the solid bounds no volume. As many as at the start or, with Reach::far, up to `most`. Deterministic.
std::vector<Sphere> fit(const Solid& solid, std::span<const Sphere> start, std::size_t most, Reach reach);

} // namespace foam::fitted
