// Searches for many covering balls: more than a search can place one by one.
#pragma once

#include "by_spheres/descent/descent.hpp"
#include "by_spheres/moves/moves.hpp"
#include "by_spheres/portfolio/portfolio.hpp"
#include "by_spheres/portfolio/problem.hpp"

#include <foam/search/spherize.hpp>

#include <algorithm>
#include <functional>

namespace foam::inline search::by_spheres {

/// Begins with clusters of points of the solid. A descent with long steps moves balls that hold nothing alone to where
/// others have much excess volume. Then, round by round with ever shorter steps: planes split balls until there are
/// enough again, a descent moves all balls and heeds the creases between them, and conditional gradients settle them.
class ManySearch {
public:
    /// The problem must outlive this; make it by problem_for().
    ManySearch(const Problem& problem, std::size_t count, const CoverOptions& options);
    /// Returns the data about a solid for `count` balls. It is the same for all counts up to `same_problem`.
    static Problem problem_for(const Solid& solid, std::size_t count, std::uint64_t seed);
    static constexpr std::size_t same_problem = 100;

    struct Found {
        std::vector<Balls> sets; ///< at most `count` balls each, which cover the surface or nearly do
        bool stopped = false;    ///< only then there may be no set
    };
    /// Searches. stop() is called now and then, in the calling thread; true ends the search.
    Found found(const DescentSurface& surface, const std::function<bool()>& stop) const;

private:
    std::vector<CoverCandidate> started(const DescentSurface& surface) const;
    CoverCandidate settled(const DescentSurface& surface, const Balls& balls, int steps) const;
    /// Replaces a candidate by a better one, if a descent with this first step gives one. Returns the balls after the
    /// descent, which cover nearly all.
    Balls refine(const DescentSurface& surface, CoverCandidate& candidate, float first_step) const;

    std::size_t count_;
    std::uint64_t seed_;
    ManyPlan plan_;
    const Problem& problem_;
    Improvement improvement_;
};

} // namespace foam::inline search::by_spheres
