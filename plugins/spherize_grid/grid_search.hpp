// The best oriented grid of cells for a number of spheres.
#pragma once

#include <foam/geometry/cell.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <map>
#include <memory>
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

/// Divides the cells of a grid into halves, quarters or eighths, always where that saves most of the union's volume per
/// additional sphere. For rising numbers of spheres it continues from its last state.
class Refinement {
public:
    explicit Refinement(const Grid& start);
    ~Refinement();
    /// Returns at most `most` cells, or those of the start. Depends only on the start and `most`, not on earlier calls.
    /// Precondition: `most` is at least that of the calls before.
    Grid at(std::size_t most, Context& context);

private:
    struct Part;
    struct Leaf;
    struct Choice;
    using Leaves = std::vector<Leaf>;
    static void measure(Leaves& leaves);
    static Choice best_choice(const Leaves& leaves, std::size_t room);
    static void divide(Leaves& leaves, const Choice& choice);

    Leaves leaves_; // as far as the divisions are the same for every larger number
};

/// Keeps grids and their refinements. The solid must outlive it.
class Search {
public:
    /// Prepares the search. `refine`: grids with fewer cells than allowed are divided further.
    Search(const Solid& solid, Cell::Content content, bool refine);

    /// Returns the whole solid, undivided.
    const Cell& whole() const { return whole_; }
    /// Returns the division into at most `most` cells whose balls have the least union volume: the best grid or, with
    /// refinement, the best of the refined grids with 1, 2, 3, 4, 6, 8, 12, 16, 24, … cells. As these numbers do not
    /// depend on `most`, more spheres never have more excess volume. Depends only on `most`, not on earlier calls.
    Grid best(std::size_t most, Context& context);

private:
    const Grid& grid(std::size_t most, Context& context);

    bool refine_;
    Cell whole_, rough_;
    Axes principal_;
    std::map<std::size_t, Grid> grids_;
    struct Growth {
        std::unique_ptr<Refinement> refinement;
        std::size_t most = 0; // largest count so far
    };
    std::map<std::size_t, Growth> growths_;
};

} // namespace foam::spherize_grid
