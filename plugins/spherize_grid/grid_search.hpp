// The best oriented grid of cells for a number of spheres.
#pragma once

#include <foam/cell.hpp>
#include <foam/context.hpp>

#include <array>
#include <map>
#include <vector>

namespace foam::spherize_grid {

using Axes = std::array<Vec3, 3>; // orthonormal, right-handed
using Counts = std::array<int, 3>;

/// A division into cells.
struct Grid {
    std::vector<Cell> cells;   ///< those that hold something
    std::vector<Sphere> balls; ///< one a cell
    double volume = 0;         ///< of the balls' union, m³
};

/// Looks for the grid of at most `most` cells whose balls have the least volume together: the finest one with
/// near-cubic cells first, then the three counts one up or down as long as that helps.
class GridSearch {
public:
    GridSearch(const Cell& cell, std::size_t most, Context& context);
    /// Counts and volumes of what was looked at, the best first; grids with too many cells are not among them.
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

/// The best grid in a cell along its axes.
Grid best_grid_in(const Cell& cell, std::size_t most, Context& context);
/// The best grid in `whole` of any orientation: along its axes, along `principal`, or turned from there. `rough` is
/// quick(whole).
Grid best_grid(const Cell& whole, const Cell& rough, const Axes& principal, std::size_t most, Context& context);
/// What a search looks at in place of a cell with very many pieces: details below a fiftieth of its size do not decide.
Cell quick(const Cell& cell);

/// The ball of each cell.
std::vector<Sphere> balls_of(const std::vector<Cell>& cells);

} // namespace foam::spherize_grid
