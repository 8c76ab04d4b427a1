// The best division of a solid for one number of spheres after another.
#pragma once

#include "refinement.hpp"

#include <map>
#include <memory>

namespace foam::spherize_grid {

/// Remembers grids and their refinements. The solid must outlive it.
class Search {
public:
    /// `refine`: grids with fewer cells than wanted are divided further.
    Search(const Solid& solid, Cell::Content content, bool refine);

    /// The whole solid, undivided.
    const Cell& whole() const { return whole_; }
    /// The division into at most `most` cells whose balls have the least volume together: the best grid or, with
    /// refinement, the best of those that grids for 1, 2, 3, 4, 6, 8, 12, 16, 24, … cells grow into. As these numbers
    /// do not depend on `most`, more spheres never claim more. Depends on `most` alone, not on what was asked before.
    Grid best(std::size_t most, Context& context);

private:
    const Grid& grid(std::size_t most, Context& context);

    bool refine_;
    Cell whole_, rough_;
    Axes principal_;
    std::map<std::size_t, Grid> grids_;
    struct Growth {
        std::unique_ptr<Refinement> refinement;
        std::size_t most = 0; // asked for so far
    };
    std::map<std::size_t, Growth> growths_;
};

} // namespace foam::spherize_grid
