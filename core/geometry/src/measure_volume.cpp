// vol(U \ S) and vol(S \ U).
#include "intervals.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/union_volume.hpp>

#include <array>

namespace foam::inline geometry {
namespace {

/// Replicates: independent estimates whose scatter gives the standard error.
constexpr std::size_t line_replicates = 4; // for each of the three axes
constexpr std::size_t estimates = 3 * line_replicates;

/// Returns mean and standard error of independent estimates.
Estimate combined(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double v : values) {
        sum += v;
    }
    for (const double v : values) {
        squares += (v - sum / n) * (v - sum / n);
    }
    return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

/// Integrates along one line parallel to each axis in each cell of a square grid over the box. `length_along(origin,
/// axis, in_balls)`: the length to sum, m, on a line that is inside the balls on `in_balls`.
template <class LengthAlong>
Estimate along_lines(const Box& box, std::span<const Sphere> balls, std::size_t lines, std::uint64_t seed,
                     LengthAlong length_along) {
    const auto across =
        static_cast<std::size_t>(std::max(2.0, std::round(std::sqrt(static_cast<double>(lines) / estimates))));
    const Vec3 cell = box.size() / static_cast<double>(across);
    std::vector<double> rows(estimates * across);
    parallel_for(rows.size(), [&](std::size_t task) {
        const std::size_t estimate = task / across;
        const int axis = static_cast<int>(estimate % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double from = box.low[u] + cell[u] * static_cast<double>(task % across);
        std::vector<Sphere> near;
        balls_between(balls, u, from, from + cell[u], near);
        Random random(derive_seed(seed + task, "volume lines"));
        Intervals in_balls;
        for (std::size_t k = 0; k < across; ++k) {
            Vec3 origin = box.low;
            origin[u] = from + cell[u] * random.uniform();
            origin[v] += cell[v] * (static_cast<double>(k) + random.uniform());
            check_cancelled();
            balls_along(near, origin, axis, in_balls);
            rows[task] += cell[u] * cell[v] * length_along(origin, axis, in_balls);
        }
    });
    std::array<double, estimates> sums{};
    for (std::size_t task = 0; task < rows.size(); ++task) {
        sums[task / across] += rows[task];
    }
    return combined(sums);
}

/// Estimates vol(S \ U). Only pieces outside the balls are examined. If the balls cover the whole closed surface, only
/// pieces between balls are: the others are outside the solid. An open solid whose surface the balls cover can have
/// little missing volume, and the queries are costly: it is zero if the solid's own lines, which are known, find none.
Estimate left_out(const Solid& solid, std::span<const Sphere> balls, bool covered, std::size_t lines,
                  std::uint64_t seed) {
    const Box& box = solid.bounds();
    const double noise = 1e-9 * box.diagonal();
    const bool between_only = covered && solid.closed();
    if (covered && !solid.closed() && solid.missing_volume(balls) == 0) {
        return {};
    }
    return along_lines(box, balls, lines, seed, [&](const Vec3& origin, int axis, const Intervals& in_balls) {
        Intervals parts;
        if (!between_only) {
            const std::array all{Solid::Interval{0, box.size()[axis]}};
            without(all, in_balls, noise, parts);
        }
        for (std::size_t i = 1; between_only && i < in_balls.size(); ++i) {
            parts.push_back({in_balls[i - 1].leave, in_balls[i].enter});
        }
        return length(solid.inside_along(origin, along(axis), parts));
    });
}

/// Estimates vol(U \ S).
Estimate claimed_wrongly(const Solid& solid, std::span<const Sphere> balls, std::size_t lines, std::uint64_t seed) {
    Box box;
    for (const Sphere& s : balls) {
        box.add(s.center - Vec3{s.radius, s.radius, s.radius});
        box.add(s.center + Vec3{s.radius, s.radius, s.radius});
    }
    const double noise = 1e-9 * box.diagonal();
    return along_lines(box, balls, lines, seed, [&](const Vec3& origin, int axis, const Intervals& in_balls) {
        Intervals outside;
        without(in_balls, solid.inside_along(origin, along(axis), in_balls), noise, outside);
        return length(outside);
    });
}

} // namespace

Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, bool covered,
                             const MeasureOptions& options) {
    if (balls.empty()) {
        return {{}, {solid.volume(), solid.volume_error()}};
    }
    // Holes cut a line into about a dozen pieces.
    const std::size_t lines = solid.closed() ? options.volume_rays : options.volume_points / 12;
    const double surplus = exact_union_volume(balls) - solid.volume();
    const auto other = [&](const Estimate& known, double difference) {
        return Estimate{known.value + difference, std::hypot(known.error, solid.volume_error())};
    };
    if (surplus >= 0) {
        const Estimate missing = left_out(solid, balls, covered, lines, options.seed);
        return {other(missing, surplus), missing};
    }
    const Estimate excess = claimed_wrongly(solid, balls, lines, options.seed);
    return {excess, other(excess, -surplus)};
}

} // namespace foam::geometry
