#include "by_spheres/portfolio/searches.hpp"

#include "by_spheres/descent/ball_cost.hpp"
#include "by_spheres/measured/points.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/measure_parts.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace foam::inline search::by_spheres {
namespace {

std::unique_ptr<BallCost> cost_by(const DistanceField* field, const ObjectivePlan& plan) {
    if (field) {
        return std::make_unique<ProtrusionCost>(*field, plan.directions, plan.evaluations);
    }
    return std::make_unique<RadiusCost>();
}

bool cheaper(const Minimax& a, const Minimax& b) {
    return a.worst < b.worst;
}

} // namespace

ObjectiveSearch::Surface::Surface(const Solid& solid, const Frame& frame, std::size_t pieces, std::size_t few)
    : skin(solid.surface(), frame, pieces), some(skin.sample(few)) {}

ObjectiveSearch::ObjectiveSearch(const Solid& solid, const CoverOptions& options)
    : solid_(solid), options_(options), plan_(portfolio_of(options.effort).objective), frame_(solid.bounds()),
      least_excess_(solid, {.effort = options.effort, .seed = options.seed, .stop = [this] { return stopped(); }}) {}

SphereCover ObjectiveSearch::alone(std::size_t count) {
    stopped_ = false;
    const Model least_excess = model_of(spherize(
        solid_, count, {.effort = options_.effort, .seed = options_.seed, .stop = [this] { return stopped(); }}));
    const Model other = stopped() ? least_excess : found(count, {least_excess.balls});
    return other.figure < least_excess.figure ? other.cover : least_excess.cover;
}

SphereCover ObjectiveSearch::cover(std::size_t count) {
    stopped_ = false;
    return rung(count).cover;
}

double ObjectiveSearch::figure(const SphereCover& cover) const {
    if (options_.objective == Objective::protrusion) {
        return geometry::protrusion(solid_, cover.spheres, MeasureOptions{}.directions_per_sphere).max;
    }
    double largest = 0;
    for (const Sphere& sphere : cover.spheres) {
        largest = std::max(largest, sphere.radius);
    }
    return largest;
}

ObjectiveSearch::Model ObjectiveSearch::model_of(SphereCover cover) const {
    Model model{std::move(cover), 0, {}};
    model.figure = figure(model.cover);
    model.balls = unit_balls(model.cover.spheres, frame_);
    return model;
}

ObjectiveSearch::Model ObjectiveSearch::rung(std::size_t count) {
    if (const auto known = rungs_.find(count); known != rungs_.end()) {
        return known->second;
    }
    Model best = model_of(least_excess_.cover(count));
    std::vector<Balls> covers{best.balls};
    const auto take = [&](Model other) {
        if (std::pair(other.figure, other.cover.volume) < std::pair(best.figure, best.cover.volume)) {
            best = std::move(other);
        }
    };
    if (count > 1) {
        Model fewer = rung(count_before(count));
        covers.push_back(fewer.balls);
        take(std::move(fewer));
    }
    if (stopped()) {
        return best;
    }
    take(found(count, covers));
    if (!stopped_) {
        rungs_.emplace(count, best);
    }
    return best;
}

const ObjectiveSearch::Surface& ObjectiveSearch::surface_for(std::size_t count) {
    constexpr std::size_t fewest_pieces = 2000, pieces_a_ball = 60, pieces_a_point = 5;
    const std::size_t pieces = std::max(fewest_pieces, pieces_a_ball * count);
    if (pieces != pieces_) {
        pieces_ = pieces;
        surface_ = std::make_unique<Surface>(solid_, frame_, pieces, pieces / pieces_a_point);
    }
    return *surface_;
}

const DistanceField* ObjectiveSearch::field_for(std::size_t count) {
    if (options_.objective != Objective::protrusion) {
        return nullptr;
    }
    // Many small balls protrude little.
    constexpr std::size_t few = 12;
    const int resolution = count <= few ? plan_.field : 2 * plan_.field;
    if (resolution != resolution_) {
        resolution_ = resolution;
        field_ = std::make_unique<DistanceField>(solid_, frame_, resolution);
    }
    return field_.get();
}

ObjectiveSearch::Model ObjectiveSearch::found(std::size_t count, const std::vector<Balls>& covers) {
    const Surface& surface = surface_for(count);
    const DistanceField* const field = field_for(count);
    const auto cost = cost_by(field, plan_);
    std::vector<Balls> begin = starts(surface, field, count);
    begin.insert(begin.end(), covers.begin(), covers.end());
    if (field && !stopped()) {
        // Where no ball is large, none protrudes far.
        begin.push_back(best_of(surface, RadiusCost(), begin, count).balls);
    }
    Minimax best = best_of(surface, *cost, begin, count);
    if (!stopped()) {
        best = with_moves(surface, *cost, std::move(best), count);
        constexpr int last_rounds = 8;
        best = MinimaxSearch(surface.skin, *cost).leaner(best, spread_directions(256, 0), last_rounds);
    }
    return model_of(proved(solid_, frame_, best.balls));
}

Minimax ObjectiveSearch::best_of(const Surface& surface, const BallCost& cost, const std::vector<Balls>& starts,
                                 std::size_t count) {
    std::vector<Minimax> looks(starts.size());
    const auto improve = [&](std::size_t i, const Balls& balls, int rounds) {
        looks[i] = MinimaxSearch(surface.skin, cost).improved(balls, count, rounds);
    };
    parallel_for(starts.size(), [&](std::size_t i) { improve(i, starts[i], plan_.first_rounds); });
    std::stable_sort(looks.begin(), looks.end(), cheaper);
    if (stopped()) {
        return looks.front();
    }
    looks.resize(std::min(looks.size(), plan_.kept));
    parallel_for(looks.size(), [&](std::size_t i) { improve(i, Balls(looks[i].balls), plan_.last_rounds); });
    return *std::min_element(looks.begin(), looks.end(), cheaper);
}

std::vector<Balls> ObjectiveSearch::starts(const Surface& surface, const DistanceField* field,
                                           std::size_t count) const {
    constexpr std::size_t most_in_a_row = 12;
    const Points& some = surface.some;
    std::vector<Balls> result{divided(some, {}, count)};
    std::ranges::move(grids(some, count, most_in_a_row), std::back_inserter(result));
    Random random(derive_seed(options_.seed, "starts of objectives") + count);
    for (std::size_t i = 0; i < plan_.random_starts; ++i) {
        result.push_back(clusters(some, count, random));
    }
    if (field) {
        if (Balls balls = dilated_inner_balls(*field, some, count); !balls.empty()) {
            result.push_back(std::move(balls));
        }
    }
    return result;
}

/// Removes a ball of low cost and splits the most expensive one, as long as that helps.
Minimax ObjectiveSearch::with_moves(const Surface& surface, const BallCost& cost, Minimax best, std::size_t count) {
    constexpr std::size_t candidates = 4;
    constexpr double least_gain = 1e-3;
    for (int move = 0; move < plan_.moves && best.balls.size() > 2 && !stopped(); ++move) {
        std::vector<std::size_t> order(best.balls.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return best.costs[a] < best.costs[b]; });
        std::erase(order, best.dearest());
        order.resize(std::min(order.size(), candidates));
        std::vector<Minimax> moved(order.size());
        parallel_for(order.size(), [&](std::size_t k) {
            moved[k] = MinimaxSearch(surface.skin, cost).moved(best, order[k], plan_.last_rounds / 2);
        });
        auto& cheapest = *std::min_element(moved.begin(), moved.end(), cheaper);
        if (!(cheapest.worst < best.worst * (1 - least_gain)) || cheapest.balls.size() > count) {
            break;
        }
        best = std::move(cheapest);
    }
    return best;
}

} // namespace foam::search::by_spheres
