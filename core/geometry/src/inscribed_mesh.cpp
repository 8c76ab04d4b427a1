#include <foam/geometry/inscribed_mesh.hpp>

#include <algorithm>
#include <optional>

namespace foam::inline geometry {

Mesh inscribed_mesh(const Element& element, int segments) {
    Mesh mesh = enclosing_mesh(element, segments);
    if (element.kind == Element::Kind::box || element.kind == Element::Kind::hull) {
        return mesh;
    }
    const Vec3 middle = element.pose.translation;
    for (Vec3& p : mesh.vertices) { // along the ray from the middle, to where it leaves the element
        const std::optional<LinePart> within = inside_along(element, middle, p - middle);
        p = middle + (p - middle) * (within ? std::clamp(within->leave, 0.0, 1.0) : 0.0);
    }
    return mesh;
}

} // namespace foam::inline geometry
