#include "cover/quick_search.hpp"

#include "cover/directions.hpp"
#include "cover/ladder.hpp"
#include "cover/plane_splits.hpp"
#include "cover/proved.hpp"
#include "cover/starts.hpp"

#include <foam/parallel.hpp>
#include <foam/union_volume.hpp>

#include <algorithm>

namespace foam::cover {
namespace {

constexpr std::size_t random_starts = 2, kept_starts = 1;
constexpr QuickDescentPlan first_plan{.steps = 40, .first_step = 0.04f, .last_step = 0.003f, .refresh = 1000};
constexpr QuickDescentPlan second_plan{.steps = 80, .first_step = 0.16f, .last_step = 0.001f, .refresh = 10};
constexpr int last_fits = 6;
/// Where balls only just meet, a proof by halving would have to cut very finely: a hair of overlap, a share of the
/// radii, helps.
constexpr double least_overlap = 1e-4;

/// Turned from step to step, so that no direction is preferred.
const std::vector<Points>& directions_of_steps() {
    static const std::vector<Points> sets = [] {
        std::vector<Points> made;
        for (std::uint64_t turn = 0; turn < 4; ++turn) {
            made.push_back(spread_directions(64, turn));
        }
        return made;
    }();
    return sets;
}

const Points& directions_of_fits() {
    static const Points directions = spread_directions(256, 0);
    return directions;
}

double volume_of(const Balls& balls) {
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        spheres.push_back({{b.x, b.y, b.z}, b.r});
    }
    return exact_union_volume(spheres);
}

} // namespace

QuickSearch::Surface::Surface(const Solid& solid, const Frame& frame, std::size_t pieces, std::size_t few)
    : skin(solid.surface(), frame, pieces), some(skin.sample(few)) {}

QuickSearch::QuickSearch(const Solid& solid, const SpherizeOptions& options)
    : solid_(solid), options_(options), frame_(solid.bounds()) {}

Cover QuickSearch::alone(std::size_t count) {
    stopped_ = false;
    // Many creases take long to prove: less of that in exchange for a thousandth of the radii.
    constexpr std::size_t few = 4;
    return finished(found(count, nullptr).front().balls, count > few ? 10 * least_overlap : least_overlap);
}

QuickSearch::Rung QuickSearch::rung(std::size_t count) {
    if (const auto known = rungs_.find(count); known != rungs_.end()) {
        return known->second;
    }
    if (count == 1) {
        const Balls one{smallest_ball(solid_, frame_)};
        return rungs_.emplace(1, Rung{one, finished(one, least_overlap)}).first->second;
    }
    Rung best = rung(count_before(count));
    if (stopped()) {
        return best;
    }
    Rated next = found(count, &best.balls).front();
    const bool complete = !stopped_;
    if (Cover made = finished(next.balls, least_overlap); made.volume < best.cover.volume) {
        best = {std::move(next.balls), std::move(made)};
    }
    if (complete) {
        rungs_.emplace(count, best);
    }
    return best;
}

const QuickSearch::Surface& QuickSearch::surface_for(std::size_t count) {
    constexpr std::size_t fewest_pieces = 2000, pieces_a_ball = 60, pieces_a_point = 5;
    const std::size_t pieces = std::max(fewest_pieces, pieces_a_ball * count);
    if (pieces != pieces_) {
        pieces_ = pieces;
        surface_ = std::make_unique<Surface>(solid_, frame_, pieces, pieces / pieces_a_point);
    }
    return *surface_;
}

std::vector<Rated> QuickSearch::found(std::size_t count, const Balls* before) {
    if (count == 1) {
        return {{0, {smallest_ball(solid_, frame_)}}};
    }
    const Surface& surface = surface_for(count);
    std::vector<Balls> begin = starts(surface, count, before);
    if (stopped()) {
        return {{0, PowerCells(surface.skin).fitted(begin.front(), directions_of_fits())}};
    }
    std::vector<Rated> looks(begin.size());
    parallel_for(begin.size(), [&](std::size_t i) { looks[i] = first_look(surface, std::move(begin[i])); });
    std::stable_sort(looks.begin(), looks.end(), claims_less);
    looks.resize(std::min(looks.size(), kept_starts));
    if (stopped()) {
        return looks;
    }
    parallel_for(looks.size(), [&](std::size_t i) { looks[i] = gone_on_with(surface, looks[i], count); });
    std::stable_sort(looks.begin(), looks.end(), claims_less);
    return looks;
}

std::vector<Rated> QuickSearch::candidates(std::size_t count, const Balls& before) {
    stopped_ = false;
    return found(count, &before);
}

std::vector<Balls> QuickSearch::starts(const Surface& surface, std::size_t count, const Balls* before) const {
    constexpr std::size_t most_in_a_row = 6;
    const Points& some = surface.some;
    std::vector<Balls> result{divided(some, before ? *before : Balls{}, count)};
    constexpr std::array<Vec3, 3> frame_axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (const auto& axes : {frame_axes, axes_of(some)}) {
        result.push_back(grid(some, axes, most_cubic(some, axes, count)));
        if (count <= most_in_a_row) {
            result.push_back(grid(some, axes, {count, 1, 1}));
        }
    }
    Random random(derive_seed(options_.seed, "quick starts") + count);
    for (std::size_t i = 0; i < random_starts; ++i) {
        result.push_back(clusters(some, count, random));
    }
    return result;
}

Rated QuickSearch::first_look(const Surface& surface, Balls balls) const {
    QuickDescent(directions_of_steps()).run(balls, first_plan, [&](Balls&, Points& points, float) {
        points = surface.some;
    });
    Rated found{0, PowerCells(surface.skin).fitted(balls, directions_of_fits())};
    found.volume = volume_of(found.balls);
    return found;
}

Rated QuickSearch::gone_on_with(const Surface& surface, const Rated& start, std::size_t count) const {
    PowerCells cells(surface.skin);
    Rated best = start;
    const auto fit = [&](Balls& balls) {
        balls = cells.fitted(balls, directions_of_fits());
        const double volume = volume_of(balls);
        if (volume < best.volume) {
            best = {volume, balls};
        }
        return volume;
    };
    Balls balls = start.balls;
    QuickDescent(directions_of_steps()).run(balls, second_plan, [&](Balls& now, Points& points, float reach) {
        fit(now);
        if (now.size() < count) {
            now = divided(surface.some, std::move(now), count);
        }
        cells.find(now);
        float largest = 0;
        for (const Ball& ball : now) {
            largest = std::max(largest, ball.r);
        }
        points = cells.borders();
        for (std::size_t p = 0; p < surface.skin.points.size(); ++p) {
            if (cells.owners().power[p] > -2 * largest * reach) {
                points.add(surface.skin.points, p);
            }
        }
    });
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < last_fits; ++i) {
        constexpr double least_gain = 1e-4;
        const double volume = fit(balls);
        if (volume > before * (1 - least_gain)) {
            break;
        }
        before = volume;
    }
    return best;
}

Cover QuickSearch::finished(const Balls& balls, double overlap) const {
    const double margin = 2e-6 * frame_.unit; // centres are rounded by less when they are written
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        spheres.push_back({frame_.from_unit({b.x, b.y, b.z}), b.r * (1 + overlap) * frame_.unit + margin});
    }
    Cover cover = proved(solid_, std::move(spheres));
    cover.volume = exact_union_volume(cover.spheres);
    return cover;
}

} // namespace foam::cover
