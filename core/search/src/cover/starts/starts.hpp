// Starts of searches.
#pragma once

#include "cover/portfolio/problem.hpp"

#include <foam/base/random.hpp>

#include <array>

namespace foam::inline search::cover {

/// Returns points that represent the solid: on its surface and inside it.
Points body_points(const Problem& problem, std::size_t count);

/// Returns `count` clusters of the points: random seeds far apart (Arthur and Vassilvitskii 2007, "k-means++"), then a
/// few rounds of Lloyd; one ball about the centroid of each.
Balls clusters(const Points& points, std::size_t count, Random& random);

/// Cuts the points' box along the axes into equal cells and returns a ball about the points in each; empty cells are
/// left out.
Balls grid(const Points& points, const std::array<Vec3, 3>& axes, const std::array<std::size_t, 3>& counts);
/// Returns the numbers of cells along the axes, `count` in all, that make the smallest cells.
std::array<std::size_t, 3> most_cubic(const Points& points, const std::array<Vec3, 3>& axes, std::size_t count);

/// Returns the axes of the points' second moments, longest extent first.
std::array<Vec3, 3> axes_of(const Points& points);

/// Returns the balls with two in place of ball `i`: clusters of the points that lie deepest in it. Returns the same
/// balls if there are too few points. `gaps`: how far each point lies outside the balls, at most.
Balls split(const Balls& balls, std::size_t i, const Points& points, const std::vector<float>& gaps, Random& random);

/// Returns grids of `count` cells or fewer along the frame's axes and along the points' own: nearly cubic cells, and a
/// row where it is not too long.
std::vector<Balls> grids(const Points& points, std::size_t count, std::size_t most_in_a_row);

} // namespace foam::search::cover
