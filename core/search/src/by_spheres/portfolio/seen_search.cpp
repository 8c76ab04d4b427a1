#include "by_spheres/portfolio/seen_search.hpp"

#include "by_spheres/portfolio/quick_refinement.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"

#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::size_t most_balls = 64;     ///< spheres asked for; more need what a search for solids knows
constexpr std::size_t points_a_ball = 16;  ///< at least: fewer are no surface
constexpr double largest_radius = 0.01;    ///< of a point, in units of half the diagonal

struct Width {
    std::size_t clusterings; ///< random starts
    std::size_t refined;     ///< starts, beyond those always worth it
    std::size_t places;      ///< points on which a search descends, in units of those of effort fast
    int fits;                ///< on all points
};
Width width_of(Effort effort) {
    return effort == Effort::fast     ? Width{1, 0, 1, 1}
           : effort == Effort::normal ? Width{8, 4, 2, 4}
                                      : Width{32, 12, 4, 4};
}

bool is_ball(const Sphere& ball) {
    return is_finite(ball.center) && std::isfinite(ball.radius) && ball.radius >= 0;
}

/// Returns the spheres about the balls' centres that hold every ball: each in the one from which it is least far out.
/// In double precision, rounded outwards.
std::vector<Sphere> holding(std::span<const Sphere> seen, const Frame& frame, const Balls& balls) {
    std::vector<Sphere> spheres;
    std::vector<double> radius(balls.size(), -1);
    for (const Ball& b : balls) {
        spheres.push_back({frame.from_unit({b.x, b.y, b.z}), b.r * frame.unit});
    }
    for (const Sphere& ball : seen) {
        std::size_t nearest = 0;
        double least = std::numeric_limits<double>::infinity(), reach = 0;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const double there = distance(ball.center, spheres[i].center) + ball.radius;
            if (there - spheres[i].radius < least) {
                least = there - spheres[i].radius;
                nearest = i;
                reach = there;
            }
        }
        radius[nearest] = std::max(radius[nearest], reach);
    }
    std::vector<Sphere> result;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (radius[i] >= 0) {
            const double scale = norm(spheres[i].center) + radius[i];
            constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
            result.push_back({spheres[i].center, radius[i] + rounding * scale});
        }
    }
    return result;
}

/// The balls to hold, and the frame of their search.
struct Seen {
    std::span<const Sphere> balls;
    Frame frame;
    FineSurface whole;
};

/// Takes the best of one more search.
void improve(std::optional<SphereCover>& best, const Seen& seen, std::size_t count, Effort effort,
             const CoverOptions& options) {
    const Width width = width_of(effort);
    const std::size_t places = width.places * DescentSurface::pieces_for(count);
    const DescentSurface surface(seen.whole.points.size() > places ? seen.whole.sample(places) : seen.whole.points,
                                 count);
    PowerCells cells(seen.whole);
    std::vector<Balls> starts =
        quick_starts(surface.some, {}, count, surface.some, width.clusterings, options.seed);
    for (const CoverCandidate& candidate :
         refined_best(surface, nullptr, count, std::move(starts), starts_worth_refining(count) + width.refined,
                      [&] { return options.stop && options.stop(); })) {
        Balls now = candidate.balls;
        for (int fit = 0; fit < width.fits; ++fit) {
            now = cells.fitted(now, directions_of_steps().front());
            SphereCover cover{holding(seen.balls, seen.frame, now), {.holds = true, .pieces = seen.balls.size()}, 0};
            cover.volume = exact_union_volume(cover.spheres);
            if (!best || cover.volume < best->volume) {
                best = std::move(cover);
            }
        }
    }
}

} // namespace

std::optional<SphereCover> cover_of_seen(std::span<const Sphere> balls, std::size_t count,
                                         const CoverOptions& options) {
    if (count == 0 || count > most_balls || balls.size() < points_a_ball * count ||
        !std::ranges::all_of(balls, is_ball)) {
        return {};
    }
    Box bounds;
    double largest = 0;
    for (const Sphere& ball : balls) {
        bounds.add(ball.center);
        largest = std::max(largest, ball.radius);
    }
    const Frame frame(bounds);
    if (!(bounds.diagonal() > 0) || !std::isfinite(bounds.diagonal()) || largest > largest_radius * frame.unit) {
        return {};
    }
    Points all;
    for (const Sphere& ball : balls) {
        all.add(frame.to_unit(ball.center));
    }
    const Seen seen{balls, frame, FineSurface(std::move(all))};
    std::optional<SphereCover> best;
    // More effort is never worse: it has the searches of less, too.
    for (const Effort effort : {Effort::fast, Effort::normal, Effort::best}) {
        if (effort == Effort::fast || (effort <= options.effort && !(options.stop && options.stop()))) {
            improve(best, seen, count, effort, options);
        }
    }
    return best;
}

} // namespace foam::search::by_spheres
