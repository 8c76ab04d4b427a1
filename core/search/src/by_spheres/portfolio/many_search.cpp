#include "by_spheres/portfolio/many_search.hpp"

#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>

#include <algorithm>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::size_t directions_a_ball = 64, first_points = 500;
constexpr int first_gradient_steps = 4, gradient_steps = 6;

/// Returns the cells of the occupancy along the longest extent: small beside the balls.
int resolution_for(std::size_t count) {
    constexpr std::size_t some = 256;
    return count <= some ? 48 : 64;
}

/// Returns the number of places to cover: enough for each ball.
std::size_t points_for(std::size_t count) {
    constexpr std::size_t fewest = 3000, a_ball = 30;
    return std::max(fewest, a_ball * count);
}

} // namespace

ManySearch::ManySearch(const Problem& problem, std::size_t count, const CoverOptions& options)
    : count_(count), seed_(derive_seed(options.seed, "many") + count), plan_(portfolio_of(options.effort).many),
      problem_(problem), improvement_(problem, directions_a_ball, first_points) {}

Problem ManySearch::problem_for(const Solid& solid, std::size_t count, std::uint64_t seed) {
    return {solid, resolution_for(count), points_for(count), seed};
}

CoverCandidate ManySearch::settled(const DescentSurface& surface, const Balls& balls, int steps) const {
    return ConditionalGradient(surface.skin, problem_.occupancy).improved(balls, steps);
}

std::vector<CoverCandidate> ManySearch::started(const DescentSurface& surface) const {
    constexpr std::size_t points_a_ball = 8, fewest_points = 800;
    const DescentPlan far{.steps = 120, .first_step = 0.3f, .last_step = 0.02f};
    const Points body = body_points(problem_, std::max(fewest_points, points_a_ball * count_));
    std::vector<CoverCandidate> candidates(plan_.starts.of(count_));
    parallel_for(candidates.size(), [&](std::size_t i) {
        Random random(seed_ + (i << 32));
        candidates[i] =
            settled(surface, improvement_.improved(clusters(body, count_, random), far, false), first_gradient_steps);
    });
    std::stable_sort(candidates.begin(), candidates.end(), has_less_volume);
    candidates.resize(std::min(candidates.size(), plan_.kept.of(count_)));
    return candidates;
}

Balls ManySearch::refine(const DescentSurface& surface, CoverCandidate& candidate, float first_step) const {
    const DescentPlan near{.steps = 120, .first_step = first_step, .last_step = 0.001f};
    Balls descended = improvement_.improved(divided(surface.skin.points, candidate.balls, count_), near, true);
    if (CoverCandidate next = settled(surface, descended, gradient_steps); has_less_volume(next, candidate)) {
        candidate = std::move(next);
    }
    return descended;
}

ManySearch::Found ManySearch::found(const DescentSurface& surface, const std::function<bool()>& stop) const {
    constexpr float longest_step = 0.02f, shorter = 0.6f;
    std::vector<CoverCandidate> candidates;
    if (!completed_unless_stopped(stop, [&] { candidates = started(surface); })) {
        return {{}, true};
    }
    Found result;
    float step = longest_step;
    for (std::size_t round = 0; round < plan_.rounds.of(count_); ++round, step *= shorter) {
        std::vector<Balls> descended(candidates.size());
        const bool completed = completed_unless_stopped(stop, [&] {
            parallel_for(candidates.size(),
                         [&](std::size_t i) { descended[i] = refine(surface, candidates[i], step); });
        });
        if (!completed) {
            result.stopped = true;
            break;
        }
        std::ranges::move(descended, std::back_inserter(result.sets));
    }
    std::ranges::transform(candidates, std::back_inserter(result.sets), &CoverCandidate::balls);
    return result;
}

} // namespace foam::inline search::by_spheres
