#include "by_spheres/portfolio/problem.hpp"

#include <foam/geometry/volumes.hpp>

#include <algorithm>

namespace foam::inline search::by_spheres {
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

Ball smallest_ball(const Solid& solid, const Frame& frame) {
    return unit_ball(minimum_enclosing_sphere(solid.surface().vertices), frame);
}

std::vector<Sphere> with_a_hair_of_overlap(const Frame& frame, const Balls& balls) {
    constexpr double overlap = 2e-5;         // share of the radius
    const double margin = 2e-6 * frame.unit; // rounding of centres when they are written is less
    std::vector<Sphere> spheres;
    for (const Ball& b : balls) {
        if (b.r > 0 || (&b == &balls.back() && spheres.empty())) {
            spheres.push_back({frame.from_unit({b.x, b.y, b.z}), b.r * (1 + overlap) * frame.unit + margin});
        }
    }
    return spheres;
}

SphereCover proved(const Solid& solid, const Frame& frame, const Balls& balls) {
    SphereCover cover{with_a_hair_of_overlap(frame, balls), {}, 0};
    cover.certificate = certify(solid, cover.spheres);
    if (!cover.certificate.holds) {
        cover.spheres = grown_to_cover(solid, std::move(cover.spheres));
        cover.certificate = certify(solid, cover.spheres);
    }
    cover.volume = exact_union_volume(cover.spheres);
    return cover;
}

} // namespace foam::inline search::by_spheres
