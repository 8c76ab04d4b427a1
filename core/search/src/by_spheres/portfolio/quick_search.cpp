#include "by_spheres/portfolio/quick_search.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/portfolio/many_search.hpp"
#include "by_spheres/portfolio/problem.hpp"
#include "by_spheres/portfolio/quick_refinement.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/geometry/volumes.hpp>

#include <algorithm>

namespace foam::inline search::by_spheres {
namespace {

constexpr int cells = 32; ///< along the longest extent of a solid, to separate inside and outside

/// Returns points that represent a solid: on its surface and as many inside it.
Points body_of(const Points& surface, const Occupancy& occupancy) {
    const Points& inside = occupancy.inside();
    const std::size_t stride = 1 + inside.size() / surface.size();
    Points body = surface;
    for (std::size_t k = 0; k < inside.size(); k += stride) {
        body.add(inside, k);
    }
    return body;
}

} // namespace

QuickSearch::QuickSearch(const Solid& solid, const CoverOptions& options)
    : solid_(solid), options_(options), frame_(solid.bounds()) {}

SphereCover QuickSearch::alone(std::size_t count) {
    stopped_ = false;
    return proved(solid_, frame_, found(count, nullptr).front().balls);
}

QuickSearch::Rung QuickSearch::rung(std::size_t count) {
    if (const auto known = rungs_.find(count); known != rungs_.end()) {
        return known->second;
    }
    if (count == 1) {
        const Balls one{smallest_ball(solid_, frame_)};
        return rungs_.emplace(1, Rung{one, proved(solid_, frame_, one)}).first->second;
    }
    Rung best = rung(quick_count_before(count));
    if (stopped()) {
        return best;
    }
    CoverCandidate next = found(count, &best.balls).front();
    const bool complete = !stopped_;
    SphereCover made = proved(solid_, frame_, next.balls);
    if (geometry::joint_volume(solid_, made.spheres) < geometry::joint_volume(solid_, best.cover.spheres)) {
        best = {std::move(next.balls), std::move(made)};
    }
    if (complete) {
        rungs_.emplace(count, best);
    }
    return best;
}

const DescentSurface& QuickSearch::surface_for(std::size_t count) {
    const std::size_t pieces = DescentSurface::pieces_for(count);
    if (pieces != pieces_) {
        surface_ = std::make_unique<DescentSurface>(solid_, frame_, count);
        pieces_ = pieces;
    }
    return *surface_;
}

const Occupancy* QuickSearch::occupancy_for(std::size_t count) {
    if (count <= few_balls) {
        return nullptr;
    }
    if (!occupancy_) {
        occupancy_ = std::make_unique<Occupancy>(solid_, frame_, cells);
    }
    return occupancy_.get();
}

std::vector<CoverCandidate> QuickSearch::found(std::size_t count, const Balls* before) {
    if (count == 1) {
        return {{0, {smallest_ball(solid_, frame_)}}};
    }
    // An allocation asks for many counts: between those on which others build, the quicker search is enough.
    const bool between = before && quick_count_before(count + 1) != count && count <= most_growing;
    if (count > few_balls && !between) {
        std::vector<CoverCandidate> result = many(count);
        if (result.empty() && !stopped_) {
            stopped_ = !completed_unless_stopped(options_.stop, [&] { result = found_quickly(count, before); });
        }
        if (!result.empty()) {
            return result;
        }
        constexpr std::size_t most_at_once = 64; // these take milliseconds
        count = std::min(count, most_at_once);
    }
    return found_quickly(count, before);
}

std::vector<CoverCandidate> QuickSearch::found_quickly(std::size_t count, const Balls* before) {
    std::vector<Balls> begin = starts(surface_for(count), occupancy_for(count), count, before);
    return refined_best(count, std::move(begin), starts_worth_refining(count));
}

std::vector<CoverCandidate> QuickSearch::refined_best(std::size_t count, std::vector<Balls> starts, std::size_t kept) {
    return by_spheres::refined_best(surface_for(count), occupancy_for(count), count, std::move(starts), kept,
                                    [this] { return stopped(); });
}

std::vector<CoverCandidate> QuickSearch::many(std::size_t count) {
    CoverOptions fast = options_;
    fast.effort = Effort::fast;
    bool needles = false;
    const bool prepared = completed_unless_stopped(options_.stop, [&] {
        needles = !surface_for(count).skin.fine;
        if (!needles && (!problem_ || std::max(problem_count_, count) > ManySearch::same_problem)) {
            problem_.emplace(ManySearch::problem_for(solid_, count, options_.seed));
            problem_count_ = count;
        }
    });
    ManySearch::Found found{{}, !prepared};
    if (prepared && !needles) {
        found = ManySearch(*problem_, count, fast).found(*surface_, options_.stop);
    }
    stopped_ = stopped_ || found.stopped;
    std::vector<CoverCandidate> result;
    for (Balls& balls : found.sets) {
        const double volume = geometry::joint_volume(solid_, proved(solid_, frame_, balls).spheres);
        result.push_back({volume, std::move(balls)});
    }
    std::stable_sort(result.begin(), result.end(), has_less_volume);
    return result;
}

std::vector<CoverCandidate> QuickSearch::candidates(std::size_t count, const Balls& before) {
    stopped_ = false;
    return found(count, &before);
}

CoverCandidate QuickSearch::candidate(std::size_t count, const Balls& more) {
    stopped_ = false;
    std::vector<Balls> starts = grids(surface_for(count).some, count, most_in_a_row);
    if (!more.empty()) {
        starts.push_back(more);
    }
    return refined_best(count, std::move(starts), 1).front();
}

std::vector<Balls> QuickSearch::starts(const DescentSurface& surface, const Occupancy* occupancy, std::size_t count,
                                       const Balls* before) const {
    const Points& some = surface.some;
    const Balls known = before ? *before : Balls{};
    return occupancy ? quick_starts(some, known, count, body_of(some, *occupancy), 2, options_.seed)
                     : quick_starts(some, known, count, some, 1, options_.seed);
}

} // namespace foam::search::by_spheres
