#include <foam/search/splitting.hpp>

#include "exchange.hpp"
#include "improvement.hpp"

#include <foam/geometry/internal/union_parts.hpp>

#include <algorithm>
#include <optional>

namespace foam::inline search::cover {
namespace {

// These only choose which ball to split and where: the result is compared by exact volumes.
constexpr int occupancy_resolution = 24;
constexpr std::size_t sampled_points = 500, sampled_directions = 64, first_points = 300;
constexpr ExchangePlan plan{.split = {12, 5, 2, 30}, .evaluations = 0, .rounds = 0, .cells = 12};
/// Number of points above which surfaces are coarsened; the final growth covers the parts beyond the coarse skin.
constexpr std::size_t most_points = 4000;
constexpr int coarse_resolution = 32;

/// Returns the spheres of the balls. Spheres that have not moved keep all their digits.
std::vector<Sphere> spheres_of(const Improvement& improvement, double unit, const Balls& balls, const Balls& before,
                               const std::vector<Sphere>& cover) {
    // Where balls only just meet, a proof by halving would cut very finely. A small overlap prevents that.
    constexpr double overlap = 1e-4, least_overlap = 1e-5; // of the radius, of the solid's size
    std::vector<Sphere> spheres = improvement.spheres_of(balls);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (i < before.size() && balls[i] == before[i]) {
            spheres[i] = cover[i];
        } else {
            spheres[i].radius += overlap * spheres[i].radius + least_overlap * unit;
        }
    }
    return spheres;
}

} // namespace

struct Splitting::Data {
    explicit Data(const Solid& solid)
        : problem(solid, occupancy_resolution, sampled_points, 0),
          improvement(problem, sampled_directions, first_points),
          skin(solid.surface(), problem.frame, most_points, coarse_resolution) {}

    Problem problem;
    Improvement improvement;
    IndexedSurface skin;
    geometry::UnionParts parts{{}}; ///< of the union of the last spheres
};

Splitting::Splitting(const Solid& solid) : data_(std::make_unique<Data>(solid)) {}
Splitting::~Splitting() = default;

Claim Splitting::one_more(const std::vector<Sphere>& cover, double volume) {
    auto& [problem, improvement, skin, parts] = *data_;
    constexpr std::size_t at_once = 3;
    constexpr double rounding = 3e-6; // larger: else slivers that no ball quite contains would be left over
    Balls before;
    for (const Sphere& s : cover) {
        before.push_back(
            ball_of({problem.frame.to_unit(s.center), s.radius / problem.frame.unit * (1 + rounding) + rounding}));
    }
    const std::vector<std::size_t> order = improvement.by_waste(before);
    const Exchange whole(problem, skin, plan, before);
    parts = parts.with(cover);
    geometry::UnionParts best_parts = parts;
    std::optional<Claim> best;
    for (std::size_t first = 0; first < order.size() && !(best && best->volume < volume); first += at_once) {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        Exchange exchange = whole;
        if (!exchange.split({begin, std::min(begin + at_once, order.end())})) {
            continue;
        }
        std::vector<Sphere> more = spheres_of(improvement, problem.frame.unit, exchange.balls(), before, cover);
        geometry::UnionParts more_parts = parts.with(more);
        const double claimed = more_parts.volume() + problem.solid->missing_volume(more);
        if (!best || claimed < best->volume) {
            best = {std::move(more), claimed};
            best_parts = std::move(more_parts);
        }
    }
    parts = std::move(best_parts);
    return best ? std::move(*best) : Claim{cover, volume};
}

} // namespace foam::search::cover
