// Growing and shrinking radii so that the balls cover a surface.
#pragma once

#include "proof/cover.hpp"

#include <foam/geometry/sphere.hpp>

#include <vector>

namespace foam::inline geometry {

/// Most halvings of pieces in growth and shrinking. certify() goes further.
inline constexpr std::uint32_t growth_halvings = 120;
/// Size of the smallest pieces, as a share of the solid's extent.
inline constexpr double smallest_grown_piece = 1e-8;
/// Factor on the slack that growth keeps, relative to proofs.
inline constexpr double growth_caution = 2;

/// Returns the number of pieces that growth and shrinking examine before they settle for a coarser result. Usual sphere
/// models need a tenth at most, needles in wide gaps any number.
std::size_t most_looks(const Solid& solid);

/// Grows balls until they cover every triangle, the worst gaps first, each by the ball that adds the least excess
/// volume; by the balls' power cells if that takes more than `looks` pieces.
void grow(const Solid& solid, std::vector<Sphere>& spheres, std::size_t looks);

/// Returns the least radius with which ball `i` contains the part that the other balls do not cover; 0 if they cover
/// everything. `limit`: a radius that suffices, and the result when `looks`, which this function decrements, reaches 0.
double needed_radius(Balls& balls, std::uint32_t i, double limit, std::size_t& looks);

/// Shrinks each sphere, the one that adds most excess volume first, to its needed radius, but not below `floor[i]`.
void shrink(const Solid& solid, std::vector<Sphere>& spheres, const std::vector<double>& floor);

} // namespace foam::geometry
