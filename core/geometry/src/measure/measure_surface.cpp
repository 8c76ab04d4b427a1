// Coverage and protrusion.
#include "measure/exposure.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/vector.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

/// Steps of the search for the farthest point from the best direction; each is a nearest-point query.
constexpr int refinements = 8;

/// Returns the largest distance found by steps. The distance to the solid is largest where the direction from the
/// nearest point continues along the ball's normal. Steps follow such directions, and are kept while they lead to
/// exposed points farther away.
double refined(const Solid& solid, const Sphere& ball, std::span<const Sphere> near, Vec3 direction, double distance) {
    for (int k = 0; k < refinements; ++k) {
        const Vec3 p = ball.center + ball.radius * direction;
        const Vec3 away = normalized(p - solid.closest(p).point);
        direction = normalized(direction + away);
        const Vec3 q = ball.center + ball.radius * direction;
        const double there = direction == Vec3{} || !exposed(q, near) ? 0 : solid.signed_distance(q);
        if (!(there > distance)) {
            break;
        }
        distance = there;
    }
    return distance;
}

ExposedSums sums_of(const Solid& solid, std::span<const Sphere> balls, std::size_t i, std::span<const Vec3> directions) {
    ExposedSums sums;
    std::vector<Sphere> near;
    if (!overlapping(balls, i, near)) {
        return sums;
    }
    const Sphere& ball = balls[i];
    Vec3 best{};
    CancellationCounter asking(64);
    for (const Vec3& n : directions) {
        asking.check();
        const Vec3 p = ball.center + ball.radius * n;
        if (!exposed(p, near)) {
            continue;
        }
        const double distance = solid.signed_distance(p);
        if (distance > 0) {
            sums.area += 1;
            sums.weighted += distance;
            if (distance > sums.farthest) {
                sums.farthest = distance;
                best = n;
            }
        }
    }
    if (sums.farthest > 0) {
        sums.farthest = refined(solid, ball, near, best, sums.farthest);
    }
    const double share = 4 * std::numbers::pi * ball.radius * ball.radius / static_cast<double>(directions.size());
    sums.area *= share;
    sums.weighted *= share;
    return sums;
}

/// Returns the sums of each ball.
std::vector<ExposedSums> parts_of(const Solid& solid, std::span<const Sphere> balls, std::size_t directions) {
    const std::vector<Vec3> normals = fibonacci_directions(std::max<std::size_t>(directions, 1));
    std::vector<ExposedSums> parts(balls.size());
    parallel_for(balls.size(), [&](std::size_t i) { parts[i] = sums_of(solid, balls, i, normals); });
    return parts;
}

} // namespace

double covered_share(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options) {
    const std::vector<SurfacePoint> points = solid.sample_surface(options.surface_points, options.seed);
    if (points.empty()) {
        return 0;
    }
    const Mesh& mesh = solid.surface();
    std::vector<Sphere> near; // the balls that reach the triangle
    std::uint32_t triangle = 0xFFFFFFFFu;
    std::size_t covered = 0;
    CancellationCounter asking(1024);
    for (const SurfacePoint& sample : points) {
        asking.check();
        if (sample.triangle != triangle) {
            triangle = sample.triangle;
            near.clear();
            const auto& [a, b, c] = mesh.triangles[triangle];
            const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
            const double radius = std::max({distance(middle, mesh.vertices[a]), distance(middle, mesh.vertices[b]),
                                            distance(middle, mesh.vertices[c])});
            for (const Sphere& s : balls) {
                if (distance(s.center, middle) <= (s.radius + radius) * (1 + 1e-12)) {
                    near.push_back(s);
                }
            }
        }
        covered += std::any_of(near.begin(), near.end(), [&](const Sphere& s) {
            return squared_norm(sample.point - s.center) <= s.radius * s.radius;
        });
    }
    return static_cast<double>(covered) / static_cast<double>(points.size());
}

std::vector<double> protrusions(const Solid& solid, std::span<const Sphere> balls, std::size_t directions) {
    std::vector<double> result;
    for (const ExposedSums& part : parts_of(solid, balls, directions)) {
        result.push_back(part.farthest);
    }
    return result;
}

Protrusion protrusion_of(std::span<const ExposedSums> parts) {
    Protrusion result;
    double weighted = 0;
    for (const ExposedSums& part : parts) {
        result.exposed_area += part.area;
        result.max = std::max(result.max, part.farthest);
        weighted += part.weighted;
    }
    result.mean = result.exposed_area > 0 ? weighted / result.exposed_area : 0;
    return result;
}

Protrusion protrusion(const Solid& solid, std::span<const Sphere> balls, std::size_t directions) {
    return protrusion_of(parts_of(solid, balls, directions));
}

} // namespace foam::geometry
