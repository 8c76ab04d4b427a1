// The best oriented grid of cells for a number of spheres.
#pragma once

#include <foam/geometry/cell.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <map>
#include <vector>

namespace foam::spherize_grid {

using Axes = std::array<Vec3, 3>; // orthonormal, right-handed
using Counts = std::array<int, 3>;

/// A division into cells.
struct Grid {
    std::vector<Cell> cells;   ///< cells that are not empty
    std::vector<Sphere> balls; ///< one per cell
    double volume = 0;         ///< of the balls' union, m³
};

/// Searches for the grid of at most `most` cells whose balls have the least union volume: the finest one with
/// near-cubic cells first, then the three counts are changed by one as long as the volume falls.
class GridSearch {
public:
    GridSearch(const Cell& cell, std::size_t most, Context& context);
    /// Returns the counts and volumes of the examined grids, the best first, without grids with too many cells.
    std::vector<std::pair<double, Counts>> ranking();

private:
    double volume(const Counts& counts);
    Counts cubic(double edge) const;
    Counts largest_cubic();
    void climb(Counts start);

    const Cell& cell_;
    Vec3 size_;
    std::size_t most_;
    Context& context_;
    std::map<Counts, double> seen_; // volume of the union; infinite if there are too many cells
};

/// Returns the best grid in a cell along its axes.
Grid best_grid_in(const Cell& cell, std::size_t most, Context& context);
/// Returns the best grid in `whole` of any orientation: along its axes, along `principal`, or rotated from there.
/// `rough` is quick(whole).
Grid best_grid(const Cell& whole, const Cell& rough, const Axes& principal, std::size_t most, Context& context);
/// Returns a cell that the search uses in place of one with very many pieces: details below a fiftieth of its size do
/// not affect the decision.
Cell quick(const Cell& cell);

/// Returns the ball of each cell.
std::vector<Sphere> balls_of(const std::vector<Cell>& cells);

} // namespace foam::spherize_grid
