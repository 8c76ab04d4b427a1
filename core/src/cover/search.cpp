#include "cover/search.hpp"

#include "cover/closing.hpp"
#include "cover/ladder.hpp"
#include "cover/missing_volume.hpp"
#include "cover/proved.hpp"
#include "cover/starts.hpp"
#include "geometry/joint_volume.hpp"

#include <foam/parallel.hpp>

#include <algorithm>
#include <cmath>

namespace foam::cover {
namespace {

/// Surfaces with more points are coarsened for the search.
constexpr std::size_t few_points = 500;

/// Balls are closed down to this, units, before they are gone on with, and in the end down to the other.
constexpr double finest_start = 1e-3, finest_end = 1e-4;

} // namespace

Plan plan_for(Effort effort) {
    if (effort == Effort::best) {
        return {.resolution = 96,
                .points = 6000,
                .first_points = 1000,
                .directions = 128,
                .starts_of_few = 12,
                .starts = 12,
                .kept_of_few = 6,
                .kept = 3,
                .coarse_steps = 200,
                .fine_steps = 160,
                .most_split = 12,
                .most_quick = 16,
                .most_exchanged = 16,
                .exchange = {{24, 7, 4, 80}, 80, 12, 20},
                .skin_resolution = 32};
    }
    return {.resolution = 48,
            .points = 3000,
            .first_points = 500,
            .directions = 96,
            .starts_of_few = 0,
            .starts = 2,
            .kept_of_few = 2,
            .kept = 1,
            .coarse_steps = 120,
            .fine_steps = 120,
            .most_split = 8,
            .most_quick = 16,
            .most_exchanged = 8,
            .exchange = {{16, 5, 2, 40}, 40, 6, 16},
            .skin_resolution = 16};
}

Search::Search(const Solid& solid, const SpherizeOptions& options)
    : solid_(solid), options_(options), plan_(plan_for(options.effort)),
      problem_(solid, plan_.resolution, plan_.points, options.seed), skin_(solid.surface(), problem_.frame),
      coarse_skin_(skin_.points.size() > few_points ? skin_.coarse(plan_.skin_resolution) : skin_),
      body_(body_points(problem_, 800)), improvement_(problem_, plan_.directions, plan_.first_points),
      quick_(solid, options) {}

Search::Model Search::model(std::size_t count) {
    if (const auto known = models_.find(count); known != models_.end()) {
        return known->second;
    }
    if (count == 1) {
        return models_.emplace(1, finished({smallest_ball(solid_, problem_.frame)})).first->second;
    }
    Model best = model(count_before(count));
    if (stopped()) {
        return best;
    }
    const Balls before = best.balls;
    const auto take = [&](const Balls& balls) {
        Model model = finished(balls);
        // More balls are never worse.
        if (model.joint < best.joint) {
            best = std::move(model);
        }
    };
    if (count <= plan_.most_split) {
        take(one_more(before));
        if (stopped()) {
            return best;
        }
    }
    if (count > 2) {
        for (const Balls& balls : found(count, before)) {
            take(balls);
        }
        if (stopped()) {
            return best;
        }
    }
    return models_.emplace(count, std::move(best)).first->second;
}

Balls Search::one_more(const Balls& cover) const {
    constexpr std::size_t most_candidates = 3;
    std::vector<std::size_t> candidates = improvement_.by_waste(cover);
    candidates.resize(std::min(candidates.size(), most_candidates));
    Exchange exchange(problem_, coarse_skin_, plan_.exchange, cover);
    if (exchange.split(candidates)) {
        exchange.settle();
    }
    return exchange.balls();
}

/// Of few balls the quick search finds what others would, and exchanges make the most of it. Of many it falls behind:
/// those begin with clusters, and long steps that put balls that get lost to use elsewhere.
std::vector<Balls> Search::found(std::size_t count, const Balls& before) {
    std::vector<Rated> rated;
    if (count <= plan_.most_quick) {
        rated = quick_.candidates(count, before);
        for (Rated& candidate : rated) {
            candidate.volume += missing_volume(problem_.occupancy, candidate.balls);
        }
    }
    if (stopped()) {
        return {rated.empty() ? before : rated.front().balls};
    }
    const std::size_t quick = rated.size();
    rated.resize(quick + (count <= plan_.most_quick ? plan_.starts_of_few : plan_.starts));
    Random random(derive_seed(options_.seed, "starts") + count);
    constexpr std::size_t points_a_ball = 6; // fewer make clusters of one point, balls of no size
    const Points more = points_a_ball * count > body_.size() ? body_points(problem_, points_a_ball * count) : Points{};
    for (std::size_t i = quick; i < rated.size(); ++i) {
        rated[i].balls = clusters(more.size() > body_.size() ? more : body_, count, random);
    }
    const DescentPlan far{.steps = plan_.coarse_steps, .first_step = 0.2f, .last_step = 0.01f};
    parallel_for(rated.size() - quick, [&](std::size_t i) {
        rated[quick + i] = improvement_.improved(rated[quick + i].balls, far, false);
        rated[quick + i].balls = improvement_.closed_balls(rated[quick + i].balls, finest_start);
    });
    const bool few = count <= plan_.most_exchanged;
    std::stable_sort(rated.begin(), rated.end(), claims_less);
    rated.resize(std::min(rated.size(), count <= plan_.most_quick ? plan_.kept_of_few : plan_.kept));
    std::vector<Balls> balls(rated.size());
    if (stopped()) {
        return {rated.front().balls};
    }
    parallel_for(balls.size(),
                 [&](std::size_t i) { balls[i] = few ? exchanged(rated[i].balls) : descended(rated[i]); });
    return balls;
}

Balls Search::exchanged(const Balls& balls) const {
    Exchange exchange(problem_, coarse_skin_, plan_.exchange, balls);
    exchange.settle();
    return exchange.balls();
}

Balls Search::descended(const Rated& start) const {
    const DescentPlan last{.steps = plan_.fine_steps, .first_step = 0.02f, .last_step = 0.001f};
    return improvement_.closed_balls(improvement_.improved(start.balls, last, true).balls, finest_end);
}

/// Made to fit the surface itself after a search on a coarse one.
Balls Search::fitted(const Balls& balls) const {
    if (coarse_skin_.points.size() == skin_.points.size() || balls.size() > plan_.most_exchanged) {
        return balls;
    }
    ExchangePlan plan = plan_.exchange;
    plan.evaluations = 12;
    plan.rounds = 1;
    Exchange exchange(problem_, skin_, plan, improvement_.closed_balls(balls, finest_start));
    exchange.settle();
    return exchange.balls();
}

Search::Model Search::finished(const Balls& balls) const {
    Model model{balls, proved(solid_, problem_.frame, fitted(balls)), 0};
    model.joint = geometry::joint_volume(solid_, model.cover.spheres);
    return model;
}

} // namespace foam::cover
