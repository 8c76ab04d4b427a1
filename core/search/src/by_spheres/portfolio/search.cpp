#include "by_spheres/portfolio/search.hpp"

#include "by_spheres/measured/missing_volume.hpp"
#include "by_spheres/moves/moves.hpp"
#include "by_spheres/portfolio/many_search.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace foam::inline search::by_spheres {
namespace {

/// Number of points above which surfaces are coarsened for the search.
constexpr std::size_t few_points = 500;

} // namespace

Search::Search(const Solid& solid, const CoverOptions& options, const Plan& plan)
    : solid_(solid), options_(options), plan_(plan), problem_(solid, plan_.resolution, plan_.points, options.seed),
      skin_(solid.surface(), problem_.frame),
      coarse_skin_(skin_.points.size() > few_points ? skin_.coarse(plan_.skin_resolution) : skin_),
      body_(body_points(problem_, 800)), improvement_(problem_, plan_.directions, plan_.first_points),
      quick_(solid, options) {}

void Search::take(Model& best, const Balls& balls) const {
    Model model = finished(balls);
    // More balls are never worse.
    if (model.joint < best.joint) {
        best = std::move(model);
    }
}

void Search::move_all(Model& best, std::size_t count) {
    for (int round = 0; round < plan_.most_moves && count <= plan_.most_moved && !stopped(); ++round) {
        const double joint = best.joint;
        if (best.balls.size() < 3) {
            break; // two balls come from all planes anyway
        }
        for (const Balls& balls : moved(Balls(best.balls))) {
            take(best, balls);
        }
        if (best.joint == joint) {
            break;
        }
    }
}

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
    const Model before = best;
    if (count > most_growing) {
        for (const Balls& balls : found_of_many(count)) {
            take(best, balls);
        }
        return stopped_ ? best : models_.emplace(count, std::move(best)).first->second;
    }
    if (count == 2) {
        const int steps = plan_.of(count).last_gradient_steps;
        take(best, settled(quick_.surface_for(count), exchanged(one_more(before.balls)), steps).balls);
        if (stopped()) {
            return best;
        }
    }
    if (!quick_.surface_for(count).skin.fine) {
        // The occupancy misses needles, so the following steps may lose the result of the quick search.
        take(best, quick_.candidates(count, before.balls).front().balls);
    }
    if (count > 2) {
        for (const Balls& balls : found(count, before, best.joint)) {
            take(best, balls);
        }
        if (stopped()) {
            return best;
        }
    }
    if (const int swaps = plan_.of(count).swaps; swaps > 0 && !stopped()) {
        const RandomSwaps random_swaps(problem_, improvement_, quick_.surface_for(count).skin, coarse_skin_);
        const std::uint64_t seed = options_.seed + count;
        take(best, random_swaps.improved(best.balls, count, swaps, seed, [&] { return stopped(); }).balls);
    }
    move_all(best, count);
    if (stopped_) {
        return best;
    }
    return models_.emplace(count, std::move(best)).first->second;
}

std::vector<Balls> Search::found_of_many(std::size_t count) {
    std::optional<Problem> problem;
    const bool prepared = completed_unless_stopped(options_.stop, [&] {
        quick_.surface_for(count);
        problem.emplace(ManySearch::problem_for(solid_, count, options_.seed));
    });
    ManySearch::Found found{{}, !prepared};
    if (prepared) {
        found = ManySearch(*problem, count, options_).found(quick_.surface_for(count), options_.stop);
    }
    stopped_ = stopped_ || found.stopped;
    return std::move(found.sets);
}

std::vector<Balls> Search::moved(const Balls& cover) {
    const DescentSurface& surface = quick_.surface_for(cover.size());
    const CountPlan& plan = plan_.of(cover.size());
    std::vector<Balls> result(cover.size());
    parallel_for(cover.size(), [&](std::size_t i) {
        Balls fewer = cover;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        fewer = settled(surface, fewer, plan.first_gradient_steps).balls;
        result[i] = settled(surface, exchanged(one_more(fewer)), plan.last_gradient_steps).balls;
    });
    return result;
}

Balls Search::grown(const Model& cover, std::size_t count) {
    Claim claim{cover.cover.spheres, cover.joint};
    if (!splitting_) {
        splitting_.emplace(solid_);
    }
    while (claim.spheres.size() < count && !stopped()) {
        Claim more = splitting_->one_more(claim.spheres, claim.volume);
        if (more.spheres.size() == claim.spheres.size()) {
            break;
        }
        claim = std::move(more);
    }
    return unit_balls(claim.spheres, problem_.frame);
}

Balls Search::one_more(const Balls& cover) const {
    constexpr std::size_t most_candidates = 3;
    std::vector<std::size_t> candidates = improvement_.by_waste(cover);
    candidates.resize(std::min(candidates.size(), most_candidates));
    Exchange exchange(problem_, coarse_skin_, plan_.of(cover.size() + 1).exchange, cover);
    exchange.split(candidates);
    return exchange.balls();
}

/// The larger set is found once, and merged for all counts that it serves. Sets of more than 48 balls are not merged:
/// about round bodies clusters are better starts.
Balls Search::merged(const DescentSurface& surface, std::size_t count) {
    constexpr std::size_t most = 48, larger_for_some = 32, larger = 64;
    if (count > most) {
        return {};
    }
    const bool some = count <= Plan::most_some;
    const std::size_t before = some ? larger_for_some : larger;
    auto known = merged_.find(before);
    if (known == merged_.end()) {
        Random random(derive_seed(options_.seed, "merged") + before);
        const Balls balls = moved_far(clusters(body_, before, random));
        known = merged_
                    .emplace(before, merged_sets(surface.skin, problem_.occupancy, settled(surface, balls, 1).balls,
                                                 some ? Plan::most_few : Plan::most_some))
                    .first;
    }
    return count < known->second.size() ? known->second[count] : Balls{};
}

/// Up to 16 balls exchange pieces with their neighbours. More are refined by descents.
std::vector<Balls> Search::found(std::size_t count, const Model& before, double joint) {
    const DescentSurface& surface = quick_.surface_for(count);
    const CountPlan& plan = plan_.of(count);
    const bool many = count > Plan::most_some;
    const Balls more = plan.grown ? grown(before, count) : Balls{};
    std::vector<CoverCandidate> rated = many ? starts_of_many(count) : starts_of_some(count, before.balls);
    std::stable_sort(rated.begin(), rated.end(), has_less_volume);
    rated.resize(std::min(rated.size(), plan.kept));
    if (stopped()) {
        return rated.empty() ? std::vector<Balls>{} : std::vector<Balls>{rated.front().balls};
    }
    if (!many) {
        drop_hopeless(rated, joint);
    }
    if (!more.empty()) {
        rated.push_back(settled(surface, more, plan.first_gradient_steps));
    }
    std::vector<Balls> balls(rated.size());
    parallel_for(balls.size(), [&](std::size_t i) {
        const Balls& start = rated[i].balls;
        balls[i] = settled(surface, many ? refined(start) : exchanged(start), plan.last_gradient_steps).balls;
        if (!many && coarse_skin_.points.size() < skin_.points.size()) {
            balls[i] = settled(surface, exchanged_finely(balls[i]), plan.last_gradient_steps).balls;
        }
    });
    if (!more.empty()) {
        balls.push_back(more);
    }
    return balls;
}

/// Starts are the balls before with one split, grids, and balls merged from more. For few balls there are enough others
/// at little cost.
std::vector<CoverCandidate> Search::starts_of_some(std::size_t count, const Balls& before) {
    const DescentSurface& surface = quick_.surface_for(count);
    const CountPlan& plan = plan_.of(count);
    std::vector<CoverCandidate> rated{{0, one_more(before)}};
    if (plan.quick) {
        std::ranges::move(quick_.candidates(count, before), std::back_inserter(rated));
    }
    if (plan.merged) {
        rated.push_back(quick_.candidate(count, merged(surface, count)));
    }
    parallel_for(rated.size(),
                 [&](std::size_t i) { rated[i] = settled(surface, rated[i].balls, plan.first_gradient_steps); });
    add_restarts(count, rated);
    return rated;
}

void Search::drop_hopeless(std::vector<CoverCandidate>& candidates, double joint) const {
    const double unit = problem_.frame.unit;
    const double excess = joint / (unit * unit * unit) - problem_.volume;
    std::erase_if(candidates, [&](const CoverCandidate& candidate) {
        return candidate.volume - problem_.volume > plan_.most_behind * excess;
    });
}

void Search::add_restarts(std::size_t count, std::vector<CoverCandidate>& rated) {
    constexpr QuickDescentPlan descent{.steps = 72, .first_step = 0.3f, .last_step = 0.003f, .refresh = 12};
    if (stopped()) {
        return;
    }
    const std::size_t first = rated.size();
    const DescentSurface& surface = quick_.surface_for(count);
    const CountPlan& plan = plan_.of(count);
    Random random(derive_seed(options_.seed, "restarts") + count);
    rated.resize(first + plan.restarts);
    for (std::size_t i = first; i < rated.size(); ++i) {
        rated[i].balls = clusters(body_, count, random);
    }
    parallel_for(plan.restarts, [&](std::size_t k) {
        CoverCandidate& start = rated[first + k];
        start = settled(surface, descended(surface, &problem_.occupancy, std::move(start.balls), count, descent),
                        plan.first_gradient_steps);
    });
}

/// Starts are clusters after long steps, and balls merged from more.
std::vector<CoverCandidate> Search::starts_of_many(std::size_t count) {
    Random random(derive_seed(options_.seed, "starts") + count);
    const CountPlan& plan = plan_.of(count);
    std::vector<CoverCandidate> rated(plan.restarts);
    for (CoverCandidate& start : rated) {
        start.balls = clusters(body_, count, random);
    }
    const DescentSurface& surface = quick_.surface_for(count);
    parallel_for(rated.size(), [&](std::size_t i) {
        constexpr int gradient_steps = 2; // enough to find the best
        rated[i] = settled(surface, moved_far(rated[i].balls), gradient_steps);
    });
    if (const Balls balls = plan.merged ? merged(surface, count) : Balls{}; !balls.empty()) {
        rated.push_back(settled(surface, balls, plan.first_gradient_steps));
    }
    return rated;
}

CoverCandidate Search::settled(const DescentSurface& surface, const Balls& balls, int steps) const {
    return ConditionalGradient(surface.skin, problem_.occupancy).improved(balls, steps);
}

Balls Search::exchanged(const Balls& balls) const {
    Exchange exchange(problem_, coarse_skin_, plan_.of(balls.size()).exchange, balls);
    exchange.settle();
    return exchange.balls();
}

/// Exchanges on the surface itself after exchanges on a coarse one.
Balls Search::exchanged_finely(const Balls& balls) const {
    ExchangePlan plan = plan_.of(balls.size()).exchange;
    plan.evaluations = 12;
    plan.rounds = 1;
    Exchange exchange(problem_, skin_, plan, balls);
    exchange.settle();
    return exchange.balls();
}

Balls Search::moved_far(const Balls& balls) const {
    const DescentPlan far{.steps = plan_.coarse_steps, .first_step = 0.2f, .last_step = 0.01f};
    return improvement_.improved(balls, far, false);
}

Balls Search::refined(const Balls& balls) const {
    const DescentPlan near{.steps = plan_.fine_steps, .first_step = 0.02f, .last_step = 0.001f};
    return improvement_.improved(balls, near, true);
}

Search::Model Search::finished(const Balls& balls) const {
    Model model{balls, proved(solid_, problem_.frame, balls), 0};
    model.joint = geometry::joint_volume(solid_, model.cover.spheres);
    return model;
}

} // namespace foam::inline search::by_spheres
