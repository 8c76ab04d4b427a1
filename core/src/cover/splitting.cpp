#include "cover/splitting.hpp"

#include <algorithm>
#include <optional>

namespace foam::cover {
namespace {

// These only choose which ball to split and where: the result is compared by exact volumes.
constexpr int resolution = 24;
constexpr std::size_t points = 500, directions = 64, first_points = 300;
constexpr ExchangePlan plan{.split = {12, 5, 2, 30}, .evaluations = 0, .rounds = 0, .cells = 12};
/// Number of points above which surfaces are coarsened; the final growth covers the parts beyond the coarse skin.
constexpr std::size_t most_points = 4000;
constexpr int coarse_resolution = 32;

Skin skin_of(const Solid& solid, const Frame& frame) {
    Skin skin(solid.surface(), frame);
    return skin.points.size() > most_points ? skin.coarse(coarse_resolution) : skin;
}

} // namespace

Splitting::Splitting(const Solid& solid)
    : problem_(solid, resolution, points, 0), improvement_(problem_, directions, first_points),
      skin_(skin_of(solid, problem_.frame)) {}

Claim Splitting::one_more(const std::vector<Sphere>& cover, double volume) {
    constexpr std::size_t at_once = 3;
    constexpr double rounding = 3e-6; // larger: else slivers that no ball quite contains would be left over
    Balls before;
    for (const Sphere& s : cover) {
        before.push_back(
            ball_of({problem_.frame.to_unit(s.center), s.radius / problem_.frame.unit * (1 + rounding) + rounding}));
    }
    const std::vector<std::size_t> order = improvement_.by_waste(before);
    const Exchange whole(problem_, skin_, plan, before);
    union_ = union_.with(cover);
    geometry::UnionParts best_union = union_;
    std::optional<Claim> best;
    for (std::size_t first = 0; first < order.size() && !(best && best->volume < volume); first += at_once) {
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        Exchange exchange = whole;
        if (!exchange.split({begin, std::min(begin + at_once, order.end())})) {
            continue;
        }
        std::vector<Sphere> more = spheres_of(exchange.balls(), before, cover);
        geometry::UnionParts parts = union_.with(more);
        const double claimed = parts.volume() + problem_.solid->missing_volume(more);
        if (!best || claimed < best->volume) {
            best = {std::move(more), claimed};
            best_union = std::move(parts);
        }
    }
    union_ = std::move(best_union);
    return best ? std::move(*best) : Claim{cover, volume};
}

/// Returns the spheres of the balls. Spheres that have not moved keep all their digits.
std::vector<Sphere> Splitting::spheres_of(const Balls& balls, const Balls& before,
                                          const std::vector<Sphere>& cover) const {
    // Where balls only just meet, a proof by halving would cut very finely. A small overlap prevents that.
    constexpr double overlap = 1e-4, least_overlap = 1e-5; // of the radius, of the solid's size
    std::vector<Sphere> spheres = improvement_.spheres_of(balls);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (i < before.size() && balls[i] == before[i]) {
            spheres[i] = cover[i];
        } else {
            spheres[i].radius += overlap * spheres[i].radius + least_overlap * problem_.frame.unit;
        }
    }
    return spheres;
}

} // namespace foam::cover
