// Volume of a union of balls.
#include <foam/base/cancellation.hpp>
#include <foam/geometry/cell.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <numbers>

namespace foam::inline geometry {
namespace {

bool solid_ball(const Sphere& s) {
    return is_finite(s.center) && std::isfinite(s.radius) && s.radius > 0;
}

} // namespace

/// Returns the volume by the divergence theorem: V = 1/3 ∮ x·n dA over the exposed parts of the balls' surfaces. With x
/// = c + r n a ball's share is r²/3 · 4π/m · Σ (c·n + r) over the exposed directions n.
double quick_union_volume(std::span<const Sphere> spheres, std::size_t directions) {
    std::vector<Sphere> balls;
    for (const Sphere& s : spheres) {
        if (solid_ball(s)) {
            balls.push_back(s);
        }
    }
    if (balls.empty() || directions == 0) {
        return 0;
    }
    Vec3 middle{};
    for (const Sphere& s : balls) {
        middle += s.center / static_cast<double>(balls.size());
    }
    const std::vector<Vec3> normals = geometry::fibonacci_directions(directions);
    double volume = 0;
    std::vector<Sphere> near;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        check_cancelled();
        const Sphere& ball = balls[i];
        if (!geometry::overlapping(balls, i, near)) {
            continue;
        }
        double sum = 0;
        for (const Vec3& n : normals) {
            if (geometry::exposed(ball.center + ball.radius * n, near)) {
                sum += dot(ball.center - middle, n) + ball.radius;
            }
        }
        volume += ball.radius * ball.radius * sum;
    }
    return volume * 4 * std::numbers::pi / (3 * static_cast<double>(directions));
}

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

} // namespace foam::inline geometry
