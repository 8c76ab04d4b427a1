// vol(U \ S) and vol(S \ U).
#include "measure/element_set.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/volumes.hpp>

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

/// Balls, as ElementSet is for other elements.
class BallSet {
public:
    explicit BallSet(std::span<const Sphere> balls) : balls_(balls) {
        for (const Sphere& s : balls) {
            box_.add(s.center - Vec3{s.radius, s.radius, s.radius});
            box_.add(s.center + Vec3{s.radius, s.radius, s.radius});
        }
    }
    using Near = std::vector<Sphere>;
    void between(int axis, double from, double to, Near& near) const { balls_between(balls_, axis, from, to, near); }
    static void along(const Near& near, const Vec3& origin, int axis, Intervals& result) {
        balls_along(near, origin, axis, result);
    }
    const Box& bounds() const { return box_; }
    double missing_in(const Solid& solid) const { return solid.missing_volume(balls_); }

private:
    std::span<const Sphere> balls_;
    Box box_;
};

double missing_in(const Solid& solid, const BallSet& set) {
    return set.missing_in(solid);
}
double missing_in(const Solid& solid, const ElementSet& set) {
    return missing_of(solid, set);
}

/// Integrates along one line parallel to each axis in each cell of a square grid over the box. `length_along(origin,
/// axis, in_set)`: the length to sum, m, on a line that is inside the balls or elements on `in_set`; it is zero on
/// lines that meet fewer than `fewest` of them.
template <class Set, class LengthAlong>
Estimate along_lines(const Box& box, const Set& set, std::size_t fewest, std::size_t lines, std::uint64_t seed,
                     LengthAlong length_along) {
    const auto across =
        static_cast<std::size_t>(std::max(2.0, std::round(std::sqrt(static_cast<double>(lines) / estimates))));
    const Vec3 cell = box.size() / static_cast<double>(across);
    std::vector<double> rows(estimates * across);
    parallel_for(rows.size(), [&](std::size_t task) {
        const std::size_t estimate = task / across;
        const int axis = static_cast<int>(estimate % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double from = box.low[u] + cell[u] * static_cast<double>(task % across);
        typename Set::Near near;
        set.between(u, from, from + cell[u], near);
        if (near.size() < fewest) {
            return;
        }
        Random random(derive_seed(seed + task, "volume lines"));
        Intervals in_set;
        CancellationCounter cancellation(8);
        for (std::size_t k = 0; k < across; ++k) {
            Vec3 origin = box.low;
            origin[u] = from + cell[u] * random.uniform();
            origin[v] += cell[v] * (static_cast<double>(k) + random.uniform());
            cancellation.check();
            set.along(near, origin, axis, in_set);
            rows[task] += cell[u] * cell[v] * length_along(origin, axis, in_set);
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
template <class Set>
Estimate left_out(const Solid& solid, const Set& set, bool covered, std::size_t lines, std::uint64_t seed) {
    if (covered && solid.covers() == Covers::solid) { // by proof
        return {};
    }
    const Box& box = solid.bounds();
    const double noise = 1e-9 * box.diagonal();
    const bool between_only = covered && solid.closed();
    if (covered && !solid.closed() && missing_in(solid, set) == 0) {
        return {};
    }
    const std::size_t fewest = between_only ? 2 : 0;
    return along_lines(box, set, fewest, lines, seed, [&](const Vec3& origin, int axis, const Intervals& in_set) {
        Intervals parts;
        if (!between_only) {
            const std::array all{Solid::Interval{0, box.size()[axis]}};
            without(all, in_set, noise, parts);
        }
        for (std::size_t i = 1; between_only && i < in_set.size(); ++i) {
            parts.push_back({in_set[i - 1].leave, in_set[i].enter});
        }
        return parts.empty() ? 0 : length(solid.inside_along(origin, along(axis), parts));
    });
}

/// Estimates vol(U \ S).
template <class Set>
Estimate claimed_wrongly(const Solid& solid, const Set& set, std::size_t lines, std::uint64_t seed) {
    const Box& box = set.bounds();
    const double noise = 1e-9 * box.diagonal();
    return along_lines(box, set, 1, lines, seed, [&](const Vec3& origin, int axis, const Intervals& in_set) {
        Intervals outside;
        without(in_set, solid.inside_along(origin, along(axis), in_set), noise, outside);
        return length(outside);
    });
}

/// `in_union`: vol(U). With an error of its own it is of no use where one volume is to follow from the other.
template <class Set>
Difference difference(const Solid& solid, const Set& set, const Estimate& in_union, bool covered,
                      const MeasureOptions& options) {
    // Holes cut a line into about a dozen pieces.
    const std::size_t lines = solid.closed() ? options.volume_rays : options.volume_points / 12;
    const double surplus = in_union.value - solid.volume();
    const auto other = [&](const Estimate& known, double difference) {
        return Estimate{known.value + difference, foam::hypot(known.error, solid.volume_error())};
    };
    if (in_union.error > 0) {
        const std::size_t some = solid.closed() ? lines : lines / 4; // each takes long, and few have a small error
        return {claimed_wrongly(solid, set, some, options.seed), left_out(solid, set, covered, some, options.seed)};
    }
    if (surplus >= 0) {
        const Estimate missing = left_out(solid, set, covered, lines, options.seed);
        return {other(missing, surplus), missing};
    }
    const Estimate excess = claimed_wrongly(solid, set, lines, options.seed);
    const bool none_missing = covered && solid.covers() == Covers::solid; // by proof
    return {excess, none_missing ? Estimate{} : other(excess, -surplus)};
}

} // namespace

Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, bool covered,
                             const MeasureOptions& options) {
    if (balls.empty()) {
        return {{}, {solid.volume(), solid.volume_error()}};
    }
    return difference(solid, BallSet(balls), {exact_union_volume(balls), 0}, covered, options);
}

Difference volume_difference(const Solid& solid, const ElementSet& set, bool covered, const MeasureOptions& options) {
    if (set.size() == 0) {
        return {{}, {solid.volume(), solid.volume_error()}};
    }
    return difference(solid, set, volume_of_union(set, set.bounds()), covered, options);
}

} // namespace foam::inline geometry
