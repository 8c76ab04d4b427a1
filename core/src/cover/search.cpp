#include "cover/search.hpp"

#include "cover/closing.hpp"
#include "cover/starts.hpp"

#include <foam/parallel.hpp>

#include <algorithm>

namespace foam::cover {
namespace {

/// Counts up to this build on the one before; larger ones on the next below of 12, 14, 16, 20, 24, 30, 36, 44, ….
constexpr std::size_t every_count = 12;

/// Surfaces with more points are coarsened for the search.
constexpr std::size_t few_points = 500;

/// Balls are closed down to this, units, before they exchange.
constexpr double finest_start = 1e-3;

std::size_t count_before(std::size_t count) {
    if (count <= every_count) {
        return count - 1;
    }
    std::size_t before = every_count, step = 2;
    while (before + step < count) {
        before += step;
        step = std::max<std::size_t>(2, before / 8 * 2);
    }
    return before;
}

} // namespace

Plan plan_for(Effort effort) {
    switch (effort) {
    case Effort::fast:
        return {.resolution = 32,
                .points = 1000,
                .first_points = 300,
                .directions = 64,
                .starts = 1,
                .kept = 1,
                .first_steps = 30,
                .steps = 60,
                .last_steps = 30,
                .moves = 0,
                .only_split = 4,
                .most_split = 4,
                .exchange = {{20, 5, 3, 40}, 40, 4, 14},
                .skin_resolution = 10};
    case Effort::normal:
        return {.resolution = 48,
                .points = 3000,
                .first_points = 500,
                .directions = 96,
                .starts = 3,
                .kept = 1,
                .first_steps = 60,
                .steps = 80,
                .last_steps = 40,
                .moves = 1,
                .only_split = 3,
                .most_split = 12,
                .exchange = {{24, 7, 4, 50}, 50, 6, 16},
                .skin_resolution = 16};
    case Effort::best:
        return {.resolution = 96,
                .points = 6000,
                .first_points = 1000,
                .directions = 128,
                .starts = 32,
                .kept = 6,
                .first_steps = 80,
                .steps = 200,
                .last_steps = 100,
                .moves = 24,
                .only_split = 1,
                .most_split = 12,
                .exchange = {{60, 9, 4, 80}, 100, 12, 20},
                .skin_resolution = 32};
    }
    return {};
}

Search::Search(const Solid& solid, const SpherizeOptions& options)
    : solid_(solid), options_(options), plan_(plan_for(options.effort)),
      problem_(solid, plan_.resolution, plan_.points, options.seed), skin_(solid.surface(), problem_.frame),
      coarse_skin_(skin_.points.size() > few_points ? skin_.coarse(plan_.skin_resolution) : skin_),
      body_(body_points(problem_, 800)), improvement_(problem_, plan_.directions, plan_.first_points) {}

const Search::Model& Search::model(std::size_t count) {
    if (const auto known = models_.find(count); known != models_.end()) {
        return known->second;
    }
    if (count == 1) {
        return models_.emplace(1, finished(smallest_ball())).first->second;
    }
    const Model& before = model(count_before(count));
    if (stopped()) {
        return before;
    }
    Model best = before;
    const auto take = [&](const Balls& balls) {
        Model model = finished(balls);
        // More balls are never worse.
        if (model.cover.volume < best.cover.volume) {
            best = std::move(model);
        }
    };
    if (count <= plan_.most_split) {
        take(one_more(before.balls));
    }
    if (count > plan_.only_split) {
        Rated found = best_of(starts(count, before.balls));
        if (count <= every_count) {
            found = moved_about(std::move(found), Random(derive_seed(options_.seed, "moves") + count));
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
    Exchange exchange(problem_, coarse_skin_, plan_.exchange, improvement_.closed_balls(balls, finest_start));
    exchange.settle();
    return exchange.balls();
}

Balls Search::smallest_ball() const {
    const Sphere sphere = minimum_enclosing_sphere(solid_.surface().vertices);
    return {ball_of({problem_.frame.to_unit(sphere.center), sphere.radius / problem_.frame.unit})};
}

Search::Starts Search::starts(std::size_t count, const Balls& before) const {
    constexpr std::size_t most_splits = 2, most_rows = 6;
    Random random(derive_seed(options_.seed, "starts") + count);
    Starts result;
    for (std::size_t first = 0; first < std::min(before.size(), most_splits); ++first) {
        result.from_before.push_back(with_splits(before, count, first, random));
    }
    constexpr std::array<Vec3, 3> frame_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (const auto& axes : {frame_axes, axes_of(body_)}) {
        result.afresh.push_back(grid(body_, axes, most_cubic(body_, axes, count)));
        if (count <= most_rows) {
            result.afresh.push_back(grid(body_, axes, {count, 1, 1}));
        }
    }
    if (Balls balls = dilated_inner_balls(problem_, count); !balls.empty()) {
        result.afresh.push_back(std::move(balls));
    }
    for (std::size_t i = 0; i < plan_.starts; ++i) {
        result.afresh.push_back(clusters(body_, count, random));
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

/// The best of each kind are gone on with: what looks better at first, a split of a good model, often ends worse.
Rated Search::best_of(const Starts& starts) const {
    const std::size_t split = starts.from_before.size();
    std::vector<Rated> rated(split + starts.afresh.size());
    parallel_for(rated.size(), [&](std::size_t i) {
        const DescentPlan plan{.steps = plan_.first_steps, .first_step = 0.04f, .last_step = 0.003f};
        rated[i] = improvement_.improved(i < split ? starts.from_before[i] : starts.afresh[i - split], plan, false);
    });
    const auto better = [](const Rated& a, const Rated& b) { return a.volume < b.volume; };
    const auto middle = rated.begin() + static_cast<std::ptrdiff_t>(split);
    std::stable_sort(rated.begin(), middle, better);
    std::stable_sort(middle, rated.end(), better);
    std::vector<Rated> kept(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(std::min(split, plan_.kept)));
    for (auto next = middle; next != rated.end() && next < middle + static_cast<std::ptrdiff_t>(plan_.kept); ++next) {
        kept.push_back(std::move(*next));
    }
    parallel_for(kept.size(), [&](std::size_t i) {
        kept[i] = improvement_.improved(std::move(kept[i].balls), {.steps = plan_.steps}, true);
    });
    return std::move(*std::min_element(kept.begin(), kept.end(), better));
}

Rated Search::moved_about(Rated best, Random random) const {
    for (int i = 0; i < plan_.moves && !stopped(); ++i) {
        Rated other = improvement_.improved(moved(best.balls, random), {.steps = plan_.steps}, true);
        if (other.volume < best.volume) {
            best = std::move(other);
        }
    }
    return best;
}

/// Without the balls whose points cost the others least, one after another, with some luck.
Balls Search::thinned(Balls balls, std::size_t count, Random& random) const {
    constexpr double luck = 1.1;
    while (balls.size() > std::max<std::size_t>(count, 1)) {
        Rated best;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            Balls others = balls;
            others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
            Rated rest = improvement_.tightened(std::move(others));
            rest.volume *= random.uniform(1, luck);
            if (best.balls.empty() || rest.volume < best.volume) {
                best = std::move(rest);
            }
        }
        balls = std::move(best.balls);
    }
    return balls;
}

/// Without the ball that is missed least, and with one of the most wasteful split instead.
Balls Search::moved(const Balls& balls, Random& random) const {
    constexpr std::size_t wasteful = 3;
    const Balls fewer = thinned(balls, balls.size() - 1, random);
    const std::vector<std::size_t> order = improvement_.by_waste(fewer);
    return split(fewer, order[random.below(std::min(order.size(), wasteful))], body_, random);
}

/// Made to fit the surface itself after a search on a coarse one.
Balls Search::fitted(const Balls& balls) const {
    if (coarse_skin_.points.size() == skin_.points.size()) {
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
    Model model{balls, {improvement_.spheres_of(fitted(balls)), {}, 0}};
    for (Sphere& s : model.cover.spheres) {
        s.radius += overlap * s.radius + margin;
    }
    model.cover.certificate = certify(solid_, model.cover.spheres);
    if (!model.cover.certificate.holds) {
        model.cover.spheres = grown_to_cover(solid_, std::move(model.cover.spheres));
        model.cover.certificate = certify(solid_, model.cover.spheres);
    }
    model.cover.volume = union_volume(model.cover.spheres);
    return model;
}

} // namespace foam::cover
