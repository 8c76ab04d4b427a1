// Meshes that enclose elements.
#include <foam/geometry/element.hpp>
#include <foam/geometry/primitive.hpp>

namespace foam::inline geometry {
namespace {

/// Returns the sum of the box and a polyhedron around the ball: the hull of the polyhedron at each corner of the box.
Mesh swept_box_mesh(const Vec3& half, double radius, int segments) {
    std::vector<Vec3> points;
    for (const Vec3& v : enclosing_mesh(Primitive{Primitive::Kind::sphere, {}, radius, 0}, segments).vertices) {
        for (int corner = 0; corner < 8; ++corner) {
            points.push_back(
                v + Vec3{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z});
        }
    }
    return convex_hull(points)->surface;
}

Mesh mesh_in_own_frame(const Element& e, int segments) {
    using Kind = Primitive::Kind;
    switch (e.kind) {
    case Element::Kind::sphere:
        return enclosing_mesh(Primitive{Kind::sphere, {}, e.radius, 0}, segments);
    case Element::Kind::capsule:
        return enclosing_mesh(Primitive{Kind::capsule, {}, e.radius, 2 * e.half.z}, segments);
    case Element::Kind::cylinder:
        return enclosing_mesh(Primitive{Kind::cylinder, {}, e.radius, 2 * e.half.z}, segments);
    case Element::Kind::hull:
        return e.hull->surface;
    case Element::Kind::swept_box:
        if (e.radius > 0) {
            return swept_box_mesh(e.half, e.radius, segments);
        }
        [[fallthrough]];
    case Element::Kind::box:
        break;
    }
    return enclosing_mesh(Primitive{Kind::box, e.half * 2, 0, 0}, segments);
}

} // namespace

Mesh enclosing_mesh(const Element& element, int segments) {
    return transformed(mesh_in_own_frame(element, segments), element.pose);
}

} // namespace foam::geometry
