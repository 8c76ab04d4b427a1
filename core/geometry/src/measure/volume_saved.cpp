#include <foam/base/cancellation.hpp>
#include <foam/geometry/cell.hpp>

#include <algorithm>
#include <numbers>

namespace foam::inline geometry {
namespace {

constexpr std::size_t point_count = 128;

/// Returns points in the unit ball with low discrepancy: those of the R3 sequence (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences") in the cube that lie within the ball.
std::array<Vec3, point_count> ball_points() {
    constexpr double g = 1.22074408460575947536; // the root of x⁴ = x + 1
    std::array<Vec3, point_count> points;
    std::size_t count = 0;
    for (int i = 1; count < point_count; ++i) {
        Vec3 point;
        double step = 1;
        for (int axis = 0; axis < 3; ++axis) {
            step /= g;
            const double value = 0.5 + i * step;
            point[axis] = 2 * (value - std::floor(value)) - 1;
        }
        if (squared_norm(point) <= 1) {
            points[count++] = point;
        }
    }
    return points;
}

bool holds(const Sphere& sphere, const Vec3& point) {
    return squared_norm(point - sphere.center) <= sphere.radius * sphere.radius;
}

bool any_holds(std::span<const Sphere> spheres, const Vec3& point) {
    return std::any_of(spheres.begin(), spheres.end(), [&](const Sphere& sphere) { return holds(sphere, point); });
}

double volume(const Sphere& sphere) {
    return 4.0 / 3.0 * std::numbers::pi * sphere.radius * sphere.radius * sphere.radius;
}

} // namespace

double volume_saved(std::span<const Sphere> spheres, std::size_t index, std::span<const Sphere> pieces) {
    static const std::array<Vec3, point_count> points = ball_points();
    const Sphere& old = spheres[index];
    double reach = old.radius;
    for (const Sphere& piece : pieces) {
        reach = std::max(reach, distance(piece.center, old.center) + piece.radius);
    }
    std::vector<Sphere> others;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        if (i != index && distance(spheres[i].center, old.center) < spheres[i].radius + reach) {
            others.push_back(spheres[i]);
        }
    }
    check_cancelled();
    int lost = 0;
    for (const Vec3& unit : points) {
        const Vec3 point = old.center + old.radius * unit;
        lost += !any_holds(pieces, point) && !any_holds(others, point);
    }
    double saved = volume(old) * lost / point_count;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        int added = 0;
        for (const Vec3& unit : points) {
            const Vec3 point = pieces[k].center + pieces[k].radius * unit;
            added += !holds(old, point) && !any_holds(pieces.first(k), point) && !any_holds(others, point);
        }
        saved -= volume(pieces[k]) * added / point_count;
    }
    return saved;
}

} // namespace foam::geometry
