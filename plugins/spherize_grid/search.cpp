#include "search.hpp"

namespace foam::spherize_grid {

Search::Search(const Solid& solid, Cell::Content content, bool refine)
    : refine_(refine), whole_(Cell::whole(solid, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, content)),
      rough_(quick(whole_)), principal_(principal_axes(solid)) {}

const Grid& Search::grid(std::size_t most, Context& context) {
    const auto [entry, fresh] = grids_.try_emplace(most);
    if (fresh) {
        entry->second = best_grid(whole_, rough_, principal_, most, context);
    }
    return entry->second;
}

Grid Search::best(std::size_t most, Context& context) {
    if (!refine_) {
        return grid(most, context);
    }
    Grid best;
    for (std::size_t start = 1; start <= most;
         start = start % 3 == 0 ? start / 3 * 4 : std::max(start + 1, start / 2 * 3)) {
        Growth& growth = growths_[start];
        if (!growth.refinement || most < growth.most) {
            growth.refinement = std::make_unique<Refinement>(grid(start, context));
        }
        growth.most = most;
        Grid grown = growth.refinement->at(most, context);
        if (best.cells.empty() || grown.volume < best.volume) {
            best = std::move(grown);
        }
    }
    return best;
}

} // namespace foam::spherize_grid
