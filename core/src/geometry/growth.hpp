// Radii that cover a surface.
#pragma once

#include "geometry/cover.hpp"

#include <foam/sphere.hpp>

#include <vector>

namespace foam::geometry {

/// Halvings to which growth and shrinking look at pieces. certify() looks further.
inline constexpr std::uint32_t growth_halvings = 120;
/// Growth keeps twice the distance from rounding that proofs ask for.
inline constexpr double growth_caution = 2;

/// Radii that are multiples of `quantum`, rounded up; as they are if quantum is 0.
double rounded_up(double radius, double quantum);

/// Pieces that growth and shrinking look at before they do with a rougher answer: usual covers take a tenth at most,
/// needles in wide gaps any number.
std::size_t most_looks(const Solid& solid);

/// Grows balls until every triangle is held, the worst gaps first, each by the ball that adds the least volume outside;
/// by the balls' power cells where that takes more than `looks`.
void grow(const Solid& solid, std::vector<Sphere>& spheres, double quantum, std::size_t looks);

/// The least radius with which ball `i` holds what the others leave uncovered; 0 if they leave nothing. `limit`: a
/// radius with which it does, and the answer where `looks`, which this counts down, come to their end.
double needed_radius(Balls& balls, std::uint32_t i, double limit, std::size_t& looks);

/// How shrinking goes about it.
struct ShrinkPlan {
    bool drop_first = false; ///< begin with the spheres that nothing needs: to the floor at once
    int rounds = 1;          ///< in all but the last only a part of the way, so that neighbours share what they give up
};

/// Shrinks each sphere, the one that adds most outside first, to its needed radius, but not below `floor[i]`.
void shrink(const Solid& solid, std::vector<Sphere>& spheres, const std::vector<double>& floor, double quantum,
            const ShrinkPlan& plan);

} // namespace foam::geometry
