// Where balls begin.
#pragma once

#include "cover/problem.hpp"

#include <foam/random.hpp>

#include <array>

namespace foam::cover {

/// Places that stand for the solid: of its surface and of its inside.
Points body_points(const Problem& problem, std::size_t count);

/// `count` clusters of the points: seeds far apart at random (Arthur and Vassilvitskii 2007, "k-means++"), then a few
/// rounds of Lloyd; a ball about the middle of each.
Balls clusters(const Points& points, std::size_t count, Random& random);

/// The points' box along the axes cut into equal cells, a ball about what is in each; empty cells are left out.
Balls grid(const Points& points, const std::array<Vec3, 3>& axes, const std::array<std::size_t, 3>& counts);
/// The numbers of cells along the axes, `count` in all, that make the smallest cells.
std::array<std::size_t, 3> most_cubic(const Points& points, const std::array<Vec3, 3>& axes, std::size_t count);

/// Axes of the points' second moments, longest extent first.
std::array<Vec3, 3> axes_of(const Points& points);

/// Balls with ball `i` replaced by two: clusters of the points that lie deepest in it. Nothing changes if there are too
/// few.
Balls split(const Balls& balls, std::size_t i, const Points& points, Random& random);

/// Grids of `count` cells or fewer along the frame's axes and along the points' own: nearly cubic cells, and a row
/// where it would not be too long.
std::vector<Balls> grids(const Points& points, std::size_t count, std::size_t most_in_a_row);

} // namespace foam::cover
