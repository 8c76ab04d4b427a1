#include "by_spheres/portfolio/quick_refinement.hpp"

#include "by_spheres/measured/missing_volume.hpp"
#include "by_spheres/starts/power_cells.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

namespace foam::inline search::by_spheres {
namespace {

constexpr QuickDescentPlan first_plan{.steps = 40, .first_step = 0.04f, .last_step = 0.003f, .refresh = 1000};
/// The refinement after the first estimates. With fewer balls, starts are nearer to the optimum, and it helps to refine
/// more of them.
struct SecondPlan {
    std::size_t most_balls, kept_starts;
    QuickDescentPlan descent;
};
constexpr std::array<SecondPlan, 3> second_plans{{
    {6, 4, {.steps = 72, .first_step = 0.08f, .last_step = 0.003f, .refresh = 12}},
    {few_balls, 2, {.steps = 72, .first_step = 0.16f, .last_step = 0.003f, .refresh = 12}},
    {SIZE_MAX, 1, {.steps = 160, .first_step = 0.25f, .last_step = 0.003f, .refresh = 12}},
}};
const SecondPlan& second_plan_for(std::size_t count) {
    return *std::find_if(second_plans.begin(), second_plans.end(),
                         [&](const SecondPlan& plan) { return count <= plan.most_balls; });
}
constexpr int last_fits = 6;

const Points& directions_of_fits() {
    static const Points directions = spread_directions(256, 0);
    return directions;
}

/// Returns vol(U \ S) + vol(S), units³; without occupancy the missing volume is taken as zero.
double claim(const Balls& balls, const Occupancy* occupancy) {
    return exact_union_volume(unit_spheres(balls)) + (occupancy ? missing_volume(*occupancy, balls) : 0);
}

} // namespace

static CoverCandidate first_look(const DescentSurface& surface, const Occupancy* occupancy, Balls balls) {
    QuickDescent(directions_of_steps(), occupancy).run(balls, first_plan, [&](const Balls&, Points& points, float) {
        points = surface.some;
    });
    CoverCandidate found{0, PowerCells(surface.skin).fitted(balls, directions_of_fits())};
    found.volume = claim(found.balls, occupancy);
    return found;
}

static CoverCandidate refined(const DescentSurface& surface, const Occupancy* occupancy, const CoverCandidate& start,
                              std::size_t count) {
    Balls balls = descended(surface, occupancy, start.balls, count, second_plan_for(count).descent);
    PowerCells cells(surface.skin);
    CoverCandidate best = start;
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < last_fits; ++i) {
        check_cancelled();
        constexpr double least_gain = 1e-4;
        balls = cells.fitted(balls, directions_of_fits());
        const double now = claim(balls, occupancy);
        if (now < best.volume) {
            best = {now, balls};
        }
        if (now > before * (1 - least_gain)) {
            break;
        }
        before = now;
    }
    return best;
}

std::vector<Balls> quick_starts(const Points& some, const Balls& before, std::size_t count, const Points& body,
                                std::size_t clusterings, std::uint64_t seed) {
    std::vector<Balls> result{divided(some, before, count)};
    std::ranges::move(grids(some, count, most_in_a_row), std::back_inserter(result));
    Random random(derive_seed(seed, "quick starts") + count);
    for (std::size_t i = 0; i < clusterings; ++i) {
        result.push_back(clusters(body, count, random));
    }
    return result;
}

std::size_t starts_worth_refining(std::size_t balls) {
    return second_plan_for(balls).kept_starts;
}

std::vector<CoverCandidate> refined_best(const DescentSurface& surface, const Occupancy* occupancy, std::size_t count,
                                         std::vector<Balls> starts, std::size_t kept,
                                         const std::function<bool()>& stopped) {
    if (stopped()) {
        return {{0, PowerCells(surface.skin).fitted(starts.front(), directions_of_fits())}};
    }
    std::vector<CoverCandidate> looks(starts.size());
    parallel_for(starts.size(),
                 [&](std::size_t i) { looks[i] = first_look(surface, occupancy, std::move(starts[i])); });
    std::stable_sort(looks.begin(), looks.end(), has_less_volume);
    looks.resize(std::min(looks.size(), kept));
    if (stopped()) {
        return looks;
    }
    parallel_for(looks.size(), [&](std::size_t i) { looks[i] = refined(surface, occupancy, looks[i], count); });
    std::stable_sort(looks.begin(), looks.end(), has_less_volume);
    return looks;
}

} // namespace foam::search::by_spheres
