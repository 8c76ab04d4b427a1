// Spheres around what a sensor saw: points, each with a radius that is small beside the spheres.
#pragma once

#include <foam/search/spherize.hpp>

#include <cstddef>
#include <optional>
#include <span>

namespace foam::inline search::by_spheres {

/// Returns at most `count` spheres such that every ball lies in one of them, with the least volume of their union that
/// is found in milliseconds: the descents of QuickSearch, on the points themselves. The proof is the distance of each
/// ball from its sphere. Nothing if the balls are few or large beside the spheres, or if one of them is no ball: then
/// the search for solids is the right one. Linear in the number of balls.
std::optional<SphereCover> cover_of_seen(std::span<const Sphere> balls, std::size_t count, const CoverOptions& options);

} // namespace foam::search::by_spheres
