#include "fewer_vertices.hpp"

#include "collapsing_hull.hpp"
#include "hull_of_points.hpp"

namespace foam::inline search::convex {
namespace {

/// Returns the corners of a box about the origin, or of a tetrahedron around it where a box has too many.
std::vector<Vec3> around_box(const Vec3& half, std::size_t most) {
    if (most < 8) {
        const Vec3 corner = -half; // the plane through the other three has the opposite corner of the box
        return {corner, corner + Vec3{6 * half.x, 0, 0}, corner + Vec3{0, 6 * half.y, 0},
                corner + Vec3{0, 0, 6 * half.z}};
    }
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back({i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
    }
    return corners;
}

} // namespace

std::shared_ptr<const Polytope> with_fewer_vertices(const Polytope& polytope, std::size_t most) {
    const std::vector<Vec3>& given = polytope.surface.vertices;
    Box box;
    for (const Vec3& p : given) {
        box.add(p);
    }
    const Vec3 origin = box.center();
    const double unit = box.diagonal();
    std::vector<Vec3> points;
    for (const Vec3& p : given) {
        points.push_back((p - origin) / unit);
    }
    HullOfPoints hull;
    hull.run(points);
    CollapsingHull collapsing(points, hull.triangles());
    if (hull.triangles().empty() || !collapsing.reduce_to(most)) {
        points = around_box(box.size() * (0.5 / unit), most);
    } else {
        points = collapsing.vertices();
    }
    for (Vec3& p : points) {
        p = origin + p * unit;
    }
    return convex_hull(points);
}

} // namespace foam::inline search::convex
