// vol(U \ S) and vol(S \ U).
#include "geometry/measure_parts.hpp"

#include <foam/parallel.hpp>
#include <foam/random.hpp>

#include <array>

namespace foam::geometry {
namespace {

/// Replicates: independent estimates whose scatter gives the standard error.
constexpr std::size_t line_replicates = 4; // for each of the three axes

struct Lengths {
    double excess = 0, missing = 0;
};

double total_length(const std::vector<Solid::Interval>& intervals) {
    double sum = 0;
    for (const Solid::Interval& i : intervals) {
        sum += i.leave - i.enter;
    }
    return sum;
}

/// Length in both of two sorted lists of disjoint intervals.
double common_length(const std::vector<Solid::Interval>& a, const std::vector<Solid::Interval>& b) {
    double sum = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        sum += std::max(0.0, std::min(a[i].leave, b[j].leave) - std::max(a[i].enter, b[j].enter));
        a[i].leave < b[j].leave ? ++i : ++j;
    }
    return sum;
}

/// The balls along a line parallel to an axis, as disjoint intervals relative to `origin`.
void balls_along(std::span<const Sphere> balls, const Vec3& origin, int axis, std::vector<Solid::Interval>& result) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    result.clear();
    for (const Sphere& s : balls) {
        const double du = s.center[u] - origin[u], dv = s.center[v] - origin[v];
        const double half2 = s.radius * s.radius - du * du - dv * dv;
        if (half2 > 0) {
            const double middle = s.center[axis] - origin[axis], half = std::sqrt(half2);
            result.push_back({middle - half, middle + half});
        }
    }
    std::sort(result.begin(), result.end(),
              [](const Solid::Interval& a, const Solid::Interval& b) { return a.enter < b.enter; });
    std::size_t count = 0;
    for (const Solid::Interval& next : result) {
        if (count > 0 && next.enter <= result[count - 1].leave) {
            result[count - 1].leave = std::max(result[count - 1].leave, next.leave);
        } else {
            result[count++] = next;
        }
    }
    result.resize(count);
}

/// Mean and standard error of independent estimates.
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

Difference combined(std::span<const Lengths> estimates) {
    std::vector<double> excess, missing;
    for (const Lengths& e : estimates) {
        excess.push_back(e.excess);
        missing.push_back(e.missing);
    }
    return {combined(excess), combined(missing)};
}

/// Lines parallel to each axis, one in each cell of a square grid over the joint box; exact along the lines.
Difference along_lines(const Solid& solid, std::span<const Sphere> balls, const Box& box,
                       const MeasureOptions& options) {
    // Lines through holes are cut into about a dozen pieces.
    const std::size_t lines = solid.closed() ? options.volume_rays : options.volume_points / 12;
    const auto across = static_cast<std::size_t>(
        std::max(2.0, std::round(std::sqrt(static_cast<double>(lines) / (3 * line_replicates)))));
    constexpr std::size_t estimates = 3 * line_replicates;
    const Vec3 size = box.size();
    std::vector<Lengths> rows(estimates * across);
    parallel_for(rows.size(), [&](std::size_t task) {
        const std::size_t row = task % across, estimate = task / across;
        const int axis = static_cast<int>(estimate % 3), u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double cell = size[u] * size[v] / static_cast<double>(across * across);
        Random random(derive_seed(options.seed + task, "volume lines"));
        Vec3 direction{};
        direction[axis] = 1;
        std::vector<Solid::Interval> in_balls;
        for (std::size_t k = 0; k < across; ++k) {
            Vec3 origin = box.low;
            origin[u] += size[u] * (static_cast<double>(row) + random.uniform()) / static_cast<double>(across);
            origin[v] += size[v] * (static_cast<double>(k) + random.uniform()) / static_cast<double>(across);
            balls_along(balls, origin, axis, in_balls);
            const std::vector<Solid::Interval> in_solid = solid.inside_along(origin, direction);
            const double both = common_length(in_balls, in_solid);
            rows[task].excess += cell * (total_length(in_balls) - both);
            rows[task].missing += cell * (total_length(in_solid) - both);
        }
    });
    std::array<Lengths, estimates> sums{};
    for (std::size_t task = 0; task < rows.size(); ++task) {
        sums[task / across].excess += rows[task].excess;
        sums[task / across].missing += rows[task].missing;
    }
    return combined(sums);
}

} // namespace

Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options) {
    Box box = solid.bounds();
    for (const Sphere& s : balls) {
        box.add(s.center - Vec3{s.radius, s.radius, s.radius});
        box.add(s.center + Vec3{s.radius, s.radius, s.radius});
    }
    return along_lines(solid, balls, box, options);
}

} // namespace foam::geometry
