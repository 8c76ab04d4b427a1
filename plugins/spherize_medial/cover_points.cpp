#include "stock.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace foam::medial {
namespace {

/// Returns the edge of the cubes in which one corner stands for all others: that many points would fill the area
/// evenly.
double spacing(const Solid& solid, const Frame& frame, std::size_t count) {
    const double area = solid.area() / (frame.scale * frame.scale);
    return std::sqrt(std::max(area, 1e-12) / static_cast<double>(std::max<std::size_t>(count, 1)));
}

void add_outermost(const std::vector<Vec3>& corners, std::vector<Vec3>& points) {
    for (const Vec3& direction : fibonacci_directions(256)) {
        const auto outermost = std::max_element(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) {
            return dot(a, direction) < dot(b, direction);
        });
        if (outermost != corners.end() && std::find(points.begin(), points.end(), *outermost) == points.end()) {
            points.push_back(*outermost);
        }
    }
}

void add_corners(const std::vector<Vec3>& corners, std::size_t limit, double cell, std::vector<Vec3>& points) {
    if (corners.size() <= limit) {
        points = corners;
        return;
    }
    add_outermost(corners, points);
    std::set<std::array<long, 3>> taken;
    CancellationCounter asking(1024);
    for (const Vec3& p : corners) {
        asking.check();
        if (taken.insert({std::lround(p.x / cell), std::lround(p.y / cell), std::lround(p.z / cell)}).second) {
            points.push_back(p);
        }
    }
}

/// Returns a point of the R2 sequence (Roberts 2018), folded into the triangle.
Vec3 spread(const Vec3& a, const Vec3& b, const Vec3& c, std::size_t index) {
    double u = std::fmod(0.5 + 0.7548776662466927 * static_cast<double>(index + 1), 1.0);
    double v = std::fmod(0.5 + 0.5698402909980532 * static_cast<double>(index + 1), 1.0);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return a + (b - a) * u + (c - a) * v;
}

} // namespace

std::vector<Vec3> cover_points(const Solid& solid, const Frame& frame, const CoverOptions& options,
                               std::uint64_t seed) {
    const Mesh mesh = welded(solid.surface());
    std::vector<Vec3> corners;
    corners.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) {
        corners.push_back(frame.to_local(v));
    }
    if (corners.empty()) { // only triangles without extent
        for (const Vec3& v : solid.surface().vertices) {
            corners.push_back(frame.to_local(v));
        }
    }
    const double cell = spacing(solid, frame, options.count);
    std::vector<Vec3> points;
    add_corners(corners, options.count, cell, points);

    const Mesh& surface = solid.surface();
    std::vector<std::uint32_t> on_triangle(surface.triangles.size(), 0);
    for (const SurfacePoint& sample : solid.sample_surface(options.count, seed)) {
        points.push_back(frame.to_local(sample.point));
        ++on_triangle[sample.triangle];
    }
    CancellationCounter asking(1024);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
        asking.check();
        const auto [i, j, k] = surface.triangles[t];
        const Vec3 a = frame.to_local(surface.vertices[i]), b = frame.to_local(surface.vertices[j]),
                   c = frame.to_local(surface.vertices[k]);
        if (std::max({distance(a, b), distance(b, c), distance(c, a)}) < 2 * cell) {
            continue;
        }
        for (std::size_t n = on_triangle[t]; n < options.per_triangle; ++n) {
            points.push_back(spread(a, b, c, n));
        }
    }
    return points;
}

} // namespace foam::medial
