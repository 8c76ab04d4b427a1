// The portfolio: which searches run for an effort and a number of balls, and for how long. All of its numbers are here.
#pragma once

#include "by_spheres/moves/moves.hpp"
#include "by_spheres/portfolio/quick_search.hpp"

#include <foam/search/cover.hpp>

#include <algorithm>
#include <cstddef>

namespace foam::inline search::by_spheres {

/// How much the search does for one count.
struct CountPlan {
    bool quick = false;       ///< starts from those of the quick search
    bool merged = false;      ///< starts from balls merged from more
    bool grown = false;       ///< starts from the balls for a smaller count, split one by one
    std::size_t restarts = 0; ///< random starts
    std::size_t kept = 1;     ///< refined starts
    int swaps = 0;            ///< random swaps that are tried
    int first_gradient_steps = 0, last_gradient_steps = 0; ///< of each start, and of those that are kept
    ExchangePlan exchange{};                               ///< for counts up to most_some
};

/// The parameters of the efforts normal and best; fast is QuickSearch.
struct Plan {
    int resolution;           ///< cells of the occupancy along the longest extent
    std::size_t points;       ///< number on the surface
    std::size_t first_points; ///< points that every descent uses
    std::size_t directions;   ///< per ball
    int coarse_steps, fine_steps;
    int most_moves;          ///< rounds of moves, each of every ball
    std::size_t most_moved;  ///< counts up to this have them
    double most_behind;      ///< excess, relative to the best, up to which starts are worth exchanges
    int skin_resolution;     ///< of a finely meshed surface, for the search
    CountPlan few, some;     ///< for counts up to 4, and up to most_some
    CountPlan between;       ///< for every second candidate count above, 20, 28, 40 and 56
    CountPlan several, many; ///< for the others, up to 32 and above

    static constexpr std::size_t most_few = 4, most_some = 16, most_several = 32;
    const CountPlan& of(std::size_t count) const {
        return count <= most_few       ? few
               : count <= most_some    ? some
               : is_between(count)     ? between
               : count <= most_several ? several
                                       : many;
    }
};

/// The parameters of an effort. The more balls, the fewer repetitions.
struct ManyPlan {
    /// At most `most`, and not more than `balls` balls in all of them; at least one.
    struct Repetitions {
        std::size_t most, balls;
        std::size_t of(std::size_t count) const { return std::clamp<std::size_t>(balls / count, 1, most); }
    };
    Repetitions starts; ///< sets of clusters to begin with
    Repetitions kept;   ///< the best of them, which are refined
    Repetitions rounds; ///< of refinement
};

/// The parameters of an effort.
struct ObjectivePlan {
    int field;                 ///< cells of the distance field along the longest extent; twice as many for many balls
    std::size_t directions;    ///< directions in which a ball's protrusion is evaluated
    int evaluations;           ///< evaluations of the cost, for the best centre of a ball
    std::size_t random_starts; ///< in addition to the rule-based starts
    std::size_t kept;          ///< starts that are refined
    int first_rounds, last_rounds;
    int moves; ///< most moves of balls from the lowest cost to the highest
};

/// A fit of spheres to a solid of many triangles.
struct FitPlan {
    int steps;      ///< of conditional gradients
    int resolution; ///< cells of the occupancy along the longest extent
};

/// What an effort does. Fast is QuickSearch; its row of `search` is for what needs one all the same.
struct Portfolio {
    Plan search;   ///< for the least excess
    Plan coarse;   ///< on a coarse solid, where a search takes little of the time of a run: more moves
    ManyPlan many; ///< above the counts of `search`
    ObjectivePlan objective;
    FitPlan fit;
};
const Portfolio& portfolio_of(Effort effort);

} // namespace foam::inline search::by_spheres
