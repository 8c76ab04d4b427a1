#include "by_spheres/moves/moves.hpp"

#include "by_spheres/starts/starts.hpp"

#include <foam/base/parallel.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline search::by_spheres {

CoverCandidate RandomSwaps::settled(const Balls& balls, int steps) const {
    return ConditionalGradient(skin_, problem_.occupancy).improved(balls, steps);
}

CoverCandidate RandomSwaps::improved(const Balls& balls, std::size_t count, int tries, std::uint64_t seed,
                                     const std::function<bool()>& stop) const {
    constexpr int gradient_steps = 4;
    const int at_once = std::clamp(tries / 8, 1, 4); // of a few, each begins with the best so far
    CoverCandidate now = settled(balls, gradient_steps);
    for (int first = 0; first < tries && !(stop && stop()); first += at_once) {
        std::vector<CoverCandidate> next(static_cast<std::size_t>(std::min(at_once, tries - first)));
        parallel_for(next.size(), [&](std::size_t i) {
            next[i] = swapped(now, count, Random(derive_seed(seed, "swaps") + static_cast<std::uint64_t>(first) + i));
        });
        if (const auto best = std::ranges::min_element(next, has_less_volume); has_less_volume(*best, now)) {
            now = std::move(*best);
        }
    }
    return now;
}

CoverCandidate RandomSwaps::swapped(const CoverCandidate& now, std::size_t count, Random random) const {
    constexpr DescentPlan first{.steps = 30, .first_step = 0.02f, .last_step = 0.005f},
        second{.steps = 120, .first_step = 0.01f, .last_step = 0.001f};
    constexpr int first_gradient_steps = 2, last_gradient_steps = 12;
    constexpr double most_behind = 1.01; // excess, relative to the present balls, that a long descent makes up for
    Balls balls = now.balls;
    if (balls.size() >= count) {
        balls.erase(balls.begin() + static_cast<std::ptrdiff_t>(random.below(balls.size())));
        balls = settled(balls, 1).balls;
    }
    while (balls.size() < count && split_one(balls, random)) {
    }
    const CoverCandidate near = settled(improvement_.improved(balls, first, true), first_gradient_steps);
    if (near.volume - problem_.volume > most_behind * (now.volume - problem_.volume)) {
        return {std::numeric_limits<double>::infinity(), {}};
    }
    return settled(improvement_.improved(near.balls, second, true), last_gradient_steps);
}

/// Looks at a few of the balls with most excess volume: with all of them, swaps would soon repeat each other.
bool RandomSwaps::split_one(Balls& balls, Random& random) const {
    constexpr std::size_t looked_at = 3, most_wasteful = 16;
    constexpr ExchangePlan plan{.split = {16, 5, 2, 40}, .evaluations = 0, .rounds = 0, .cells = 12};
    const std::vector<std::size_t> order = improvement_.by_waste(balls);
    std::vector<std::size_t> candidates(looked_at);
    for (std::size_t& candidate : candidates) {
        candidate = order[random.below(std::min(order.size(), most_wasteful))];
    }
    Exchange exchange(problem_, coarse_, plan, balls);
    const bool split = exchange.split(candidates);
    balls = exchange.balls();
    return split;
}

} // namespace foam::inline search::by_spheres
