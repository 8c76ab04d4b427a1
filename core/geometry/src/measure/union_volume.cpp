// Volume of a union of balls.
#include <foam/base/cancellation.hpp>
#include <foam/geometry/directions.hpp>
#include <foam/geometry/internal/overlap.hpp>
#include <foam/geometry/measure.hpp>

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

} // namespace foam::geometry
