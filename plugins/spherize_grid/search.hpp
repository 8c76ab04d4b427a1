// The best division of a solid for one number of spheres after another.
#pragma once

#include "refinement.hpp"

#include <map>
#include <memory>

namespace foam::spherize_grid {

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
