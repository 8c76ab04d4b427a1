#include "cover/search.hpp"

#include "cover/closing.hpp"
#include "cover/ladder.hpp"
#include "cover/proved.hpp"
#include "cover/starts.hpp"

#include <foam/parallel.hpp>

#include <algorithm>

namespace foam::cover {
namespace {

/// Surfaces with more points are coarsened for the search.
constexpr std::size_t few_points = 500;

/// Balls are closed down to this, units, before they exchange; those that do not, down to the other.
constexpr double finest_start = 1e-3, finest_end = 1e-4;

} // namespace

Plan plan_for(Effort effort) {
    if (effort == Effort::best) {
        return {.resolution = 96,
                .points = 6000,
                .first_points = 1000,
                .directions = 128,
                .starts = 24,
                .kept = 6,
                .kept_of_many = 3,
                .coarse_steps = 200,
                .fine_steps = 160,
                .only_split = 1,
                .most_split = 12,
                .most_exchanged = 24,
                .exchange = {{60, 9, 4, 80}, 100, 12, 20},
                .skin_resolution = 32};
    }
    return {.resolution = 48,
            .points = 3000,
            .first_points = 500,
            .directions = 96,
            .starts = 2,
            .kept = 2,
            .kept_of_many = 1,
            .coarse_steps = 120,
            .fine_steps = 80,
            .only_split = 3,
            .most_split = 4,
            .most_exchanged = 8,
            .exchange = {{24, 7, 4, 50}, 50, 6, 16},
            .skin_resolution = 16};
}

Search::Search(const Solid& solid, const SpherizeOptions& options)
    : solid_(solid), options_(options), plan_(plan_for(options.effort)),
      problem_(solid, plan_.resolution, plan_.points, options.seed), skin_(solid.surface(), problem_.frame),
      coarse_skin_(skin_.points.size() > few_points ? skin_.coarse(plan_.skin_resolution) : skin_),
      body_(body_points(problem_, 800)), improvement_(problem_, plan_.directions, plan_.first_points) {}

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
        if (model.cover.volume < best.cover.volume) {
            best = std::move(model);
        }
    };
    if (count <= plan_.most_split) {
        take(one_more(before));
        if (stopped()) {
            return best;
        }
    }
    if (count > plan_.only_split) {
        const Rated found = best_of(starts(count, before), count);
        if (stopped()) {
            take(improvement_.closed_balls(found.balls, finest_start));
            return best;
        }
        take(settled(found.balls));
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

Balls Search::settled(const Balls& balls) const {
    if (balls.size() > plan_.most_exchanged) {
        return improvement_.closed_balls(balls, finest_end);
    }
    Exchange exchange(problem_, coarse_skin_, plan_.exchange, improvement_.closed_balls(balls, finest_start));
    exchange.settle();
    return exchange.balls();
}

Search::Starts Search::starts(std::size_t count, const Balls& before) const {
    constexpr std::size_t most_splits = 2, most_rows = 6, most_in_grids = 8;
    Random random(derive_seed(options_.seed, "starts") + count);
    Starts result;
    for (std::size_t first = 0; first < std::min(before.size(), most_splits); ++first) {
        result.rough.push_back(with_splits(before, count, first, random));
    }
    for (std::size_t i = 0; i < plan_.starts; ++i) {
        result.rough.push_back(clusters(body_, count, random));
    }
    constexpr std::array<Vec3, 3> frame_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (const auto& axes : {frame_axes, axes_of(body_)}) {
        if (count <= most_in_grids) {
            result.regular.push_back(grid(body_, axes, most_cubic(body_, axes, count)));
        }
        if (count <= most_rows) {
            result.regular.push_back(grid(body_, axes, {count, 1, 1}));
        }
    }
    return result;
}

/// The balls that waste most split in two each, from the one numbered `first` in that order.
Balls Search::with_splits(const Balls& before, std::size_t count, std::size_t first, Random& random) const {
    const std::vector<std::size_t> order = improvement_.by_waste(before);
    Balls balls = before;
    const std::size_t tries = order.size() + 4 * count;
    for (std::size_t k = first; balls.size() < count && k < tries; ++k) {
        balls = split(balls, k < order.size() ? order[k] : random.below(balls.size()), body_, random);
    }
    return balls;
}

/// Rough starts take long steps first: they have far to go, and balls that get lost are put to use elsewhere. Grids may
/// be all but right.
Rated Search::best_of(const Starts& starts, std::size_t count) const {
    const DescentPlan far{.steps = plan_.coarse_steps, .first_step = 0.2f, .last_step = 0.01f};
    const DescentPlan near{.steps = plan_.coarse_steps / 3, .first_step = 0.04f, .last_step = 0.01f};
    const DescentPlan last{.steps = plan_.fine_steps, .first_step = 0.02f, .last_step = 0.001f};
    const std::size_t rough = starts.rough.size();
    std::vector<Rated> rated(rough + starts.regular.size());
    parallel_for(rated.size(), [&](std::size_t i) {
        rated[i] = i < rough ? improvement_.improved(starts.rough[i], far, false)
                             : improvement_.improved(starts.regular[i - rough], near, false);
    });
    const auto better = [](const Rated& a, const Rated& b) { return a.volume < b.volume; };
    std::stable_sort(rated.begin(), rated.end(), better);
    rated.resize(std::min(rated.size(), count <= plan_.most_exchanged ? plan_.kept : plan_.kept_of_many));
    parallel_for(rated.size(),
                 [&](std::size_t i) { rated[i] = improvement_.improved(std::move(rated[i].balls), last, true); });
    return std::move(*std::min_element(rated.begin(), rated.end(), better));
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
    const double margin = 2e-6 * problem_.frame.unit; // centres are rounded by less when they are written
    // Where balls only just meet, a proof by halving would have to cut very finely: a hair of overlap helps.
    constexpr double overlap = 1e-4;
    std::vector<Sphere> spheres = improvement_.spheres_of(fitted(balls));
    for (Sphere& s : spheres) {
        s.radius += overlap * s.radius + margin;
    }
    Model model{balls, proved(solid_, std::move(spheres))};
    model.cover.volume = union_volume(model.cover.spheres);
    return model;
}

} // namespace foam::cover
