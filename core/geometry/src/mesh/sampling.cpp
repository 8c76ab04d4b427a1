#include "mesh/surface_points.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/random.hpp>

namespace foam::inline geometry {

std::vector<SurfacePoint> sampled_surface(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<double> up_to; // area of the triangles up to and including this one
    up_to.reserve(mesh.triangles.size());
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
        up_to.push_back(sum);
    }
    Random random(derive_seed(seed, "sample_surface"));
    std::vector<SurfacePoint> points;
    points.reserve(count);
    std::size_t triangle = 0;
    double first = random.uniform(), second = random.uniform();
    CancellationCounter asking(4096);
    for (std::size_t i = 0; i < count; ++i) {
        asking.check();
        const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * sum;
        while (triangle + 1 < up_to.size() && !(at < up_to[triangle])) {
            ++triangle;
        }
        const auto& [ia, ib, ic] = mesh.triangles[triangle];
        const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
        first += 0.7548776662466927;
        first -= first >= 1 ? 1 : 0;
        second += 0.5698402909980532;
        second -= second >= 1 ? 1 : 0;
        const double root = std::sqrt(first), v = second;
        points.push_back({a + (b - a) * (root * (1 - v)) + (c - a) * (root * v), normalized(cross(b - a, c - a)),
                          static_cast<std::uint32_t>(triangle)});
    }
    return points;
}

std::vector<SurfacePoint> Solid::sample_surface(std::size_t count, std::uint64_t seed) const {
    return geometry::sampled_surface(surface(), count, seed);
}

} // namespace foam::geometry
