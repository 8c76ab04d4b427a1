#include "cover/portfolio/problem.hpp"

#include <algorithm>

namespace foam::inline search::cover {
namespace {

/// Adds at most `most` of the vertices in use. The farthest along the eight diagonals in each grid cell would be
/// sufficient; every n-th vertex in order of position serves as well together with the even points.
void add_vertices(const Solid& solid, const Frame& frame, std::size_t most, Points& points) {
    std::vector<char> used(solid.surface().vertices.size(), 0);
    for (const Triangle& t : solid.surface().triangles) {
        used[t[0]] = used[t[1]] = used[t[2]] = 1;
    }
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i]) {
            vertices.push_back(solid.surface().vertices[i]);
        }
    }
    // Raw meshes repeat a corner for each of its triangles.
    const auto before = [](const Vec3& a, const Vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    };
    std::sort(vertices.begin(), vertices.end(), before);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    const std::size_t step = vertices.size() / most + 1;
    for (std::size_t i = 0; i < vertices.size(); i += step) {
        points.add(frame.to_unit(vertices[i]));
    }
}

} // namespace

Problem::Problem(const Solid& s, int resolution, std::size_t points, std::uint64_t seed)
    : solid(&s), frame(s.bounds()), occupancy(s, frame, resolution), volume(occupancy.volume()) {
    add_vertices(s, frame, points / 2, surface);
    for (const SurfacePoint& sample : s.sample_surface(points - std::min(points / 2, surface.size()), seed)) {
        surface.add(frame.to_unit(sample.point));
    }
}

} // namespace foam::search::cover
