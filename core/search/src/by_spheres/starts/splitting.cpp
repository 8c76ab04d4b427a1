#include <foam/search/refine.hpp>

#include "by_spheres/moves/moves.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/internal/solids.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

namespace foam::inline search::by_spheres {
namespace {

// These only choose which ball to split and where: the result is compared by exact volumes.
constexpr int occupancy_resolution = 24;
constexpr std::size_t sampled_points = 500, sampled_directions = 64, points_at_first = 300;
constexpr ExchangePlan plan{.split = {12, 5, 2, 30}, .evaluations = 0, .rounds = 0, .cells = 12};
/// Number of points above which surfaces are coarsened; the final growth covers the parts beyond the coarse skin.
constexpr std::size_t most_points = 4000;
constexpr int coarse_resolution = 32;

/// Spheres are enlarged by this for the search: else slivers that no ball quite contains would be left over.
constexpr double rounding = 3e-6; // of the radius, and of the solid's size

bool meets_any(const Ball& ball, const Balls& others) {
    return std::any_of(others.begin(), others.end(), [&](const Ball& other) { return meet(ball, other); });
}

/// Returns the sphere of a new ball. Where balls only just meet, a proof by halving would cut very finely; a small
/// overlap prevents that.
Sphere sphere_of_new(const Frame& frame, const Ball& ball) {
    constexpr double overlap = 1e-4, least_overlap = 1e-5; // of the radius, of the solid's size
    Sphere sphere{frame.from_unit(center_of(ball)), ball.r * frame.unit};
    sphere.radius += overlap * sphere.radius + least_overlap * frame.unit;
    return sphere;
}

/// What is known of the splits of a ball. It stays so until a ball near it changes.
struct KnownSplits {
    std::optional<Exchange::Look> look;
    bool tried = false;
    std::optional<geometry::UnionParts::Split> best; ///< after a try: nothing if it has none
};

} // namespace

struct [[gnu::visibility("hidden")]] Splitting::Data {
    explicit Data(const Solid& solid)
        : coarse(geometry::coarse_solid(solid)),
          problem(coarse ? *coarse : solid, occupancy_resolution, sampled_points, 0),
          improvement(problem, sampled_directions, points_at_first),
          skin(problem.solid->surface(), problem.frame, most_points, coarse_resolution),
          exchange(problem, skin, plan, {}), missing(solid) {}

    /// Replaces the spheres, and forgets what was known of splits near those that changed.
    void take(const std::vector<Sphere>& cover);
    /// Returns the one of the named spheres whose split gains most, with its best split in `known`; nothing if there is
    /// none.
    std::optional<std::size_t> best_of(std::span<const std::size_t> named);
    const Exchange::Look& look_at(std::size_t i);

    std::shared_ptr<const Solid> coarse; ///< of a solid of many triangles
    Problem problem;
    Improvement improvement;
    IndexedSurface skin;
    Exchange exchange;
    std::vector<Sphere> spheres;
    geometry::UnionParts parts{{}}; ///< of the union of the spheres
    geometry::MissingParts missing;
    std::vector<double> wastes; ///< of each ball
    std::vector<KnownSplits> known;
};

Splitting::Splitting(const Solid& solid) : data_(std::make_unique<Data>(solid)) {}
Splitting::~Splitting() = default;

void Splitting::Data::take(const std::vector<Sphere>& cover) {
    const Frame& frame = problem.frame;
    std::vector<Sphere> changed; // before and after the change
    Balls changed_balls, balls;
    for (std::size_t i = 0; i < std::max(cover.size(), spheres.size()); ++i) {
        const bool was = i < spheres.size(), is = i < cover.size();
        if (is) {
            balls.push_back(ball_of(
                {frame.to_unit(cover[i].center), cover[i].radius / frame.unit * (1 + rounding) + rounding}));
        }
        if (was && is && spheres[i] == cover[i]) {
            continue;
        }
        if (was) {
            changed.push_back(spheres[i]);
            changed_balls.push_back(exchange.balls()[i]);
        }
        if (is) {
            changed.push_back(cover[i]);
            changed_balls.push_back(balls[i]);
        }
    }
    spheres = cover;
    exchange.take(balls);
    parts = parts.with(cover);
    missing.take(cover);
    wastes.resize(balls.size());
    known.resize(balls.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (meets_any(balls[i], changed_balls)) {
            wastes[i] = improvement.waste(balls, i);
        }
        if (!known[i].look || meets_any(known[i].look->reach, changed_balls)) {
            known[i] = {};
        } else if (known[i].best) {
            known[i].best->forget(parts, changed);
        }
    }
}

const Exchange::Look& Splitting::Data::look_at(std::size_t i) {
    if (!known[i].look) {
        known[i].look = exchange.look_at_splits(i);
        auto& starts = known[i].look->starts;
        starts.resize(std::min(starts.size(), static_cast<std::size_t>(plan.split.kept))); // others are never improved
    }
    return *known[i].look;
}

std::optional<std::size_t> Splitting::Data::best_of(std::span<const std::size_t> named) {
    double most = -std::numeric_limits<double>::infinity();
    std::optional<std::size_t> chosen;
    for (const std::size_t i : named) {
        check_cancelled();
        if (const double gain = look_at(i).gain; gain > most) {
            most = gain;
            chosen = i;
        }
    }
    if (!chosen) {
        return std::nullopt;
    }
    KnownSplits& splits = known[*chosen];
    if (!splits.tried) {
        splits.tried = true;
        if (const auto two = exchange.best_split(*chosen, splits.look->starts)) {
            splits.best = {*chosen, sphere_of_new(problem.frame, two->front()),
                           sphere_of_new(problem.frame, two->back())};
        }
    }
    return splits.best ? chosen : std::nullopt;
}

Claim Splitting::one_more(const std::vector<Sphere>& cover, double volume) {
    constexpr std::size_t at_once = 3;
    data_->take(cover);
    const std::vector<std::size_t> order = by_falling(data_->wastes);
    std::optional<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < order.size() && !(best && least < volume); first += at_once) {
        const auto chosen =
            data_->best_of(std::span(order).subspan(first, std::min(at_once, order.size() - first)));
        if (!chosen) {
            continue;
        }
        geometry::UnionParts::Split& split = *data_->known[*chosen].best;
        const double claimed =
            data_->parts.volume_with(split) + data_->missing.volume_with(*chosen, split.first, split.second);
        if (!best || claimed < least) {
            best = chosen;
            least = claimed;
        }
    }
    if (!best) {
        return {cover, volume};
    }
    Claim more{cover, least};
    more.spheres[*best] = data_->known[*best].best->first;
    more.spheres.push_back(data_->known[*best].best->second);
    return more;
}

} // namespace foam::search::by_spheres
