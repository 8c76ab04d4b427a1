#include <foam/runtime/internal/elements.hpp>

#include <foam/geometry/internal/single_precision.hpp>

#include <algorithm>
#include <limits>
#include <memory>

namespace foam::inline runtime {
namespace {

/// Returns the rotation with numbers in single precision, orthonormal to double precision again.
std::array<Vec3, 3> rounded(const std::array<Vec3, 3>& rotation) {
    const Vec3 x = normalized(geometry::in_single_precision(rotation[0]));
    const Vec3 y = geometry::in_single_precision(rotation[1]);
    const Vec3 across = normalized(y - x * dot(x, y));
    return {x, across, cross(x, across)};
}

} // namespace

Approximation moved(Approximation approximation, const Pose& pose) {
    for (Approximation::Level& level : approximation.levels) {
        level.elements = geometry::moved(std::move(level.elements), pose);
    }
    return approximation;
}

void add_elements(Panel& panel, const Elements& elements, const Pose& pose) {
    for (const Sphere& sphere : elements.spheres()) {
        panel.spheres.push_back({pose * sphere.center, sphere.radius});
    }
    for (const Element& element : elements.shaped()) {
        panel.meshes.push_back({std::make_shared<const Mesh>(enclosing_mesh(element)), pose, true});
    }
}

Elements in_single_precision(Elements elements) {
    for (Sphere& s : elements.spheres()) {
        s = {geometry::in_single_precision(s.center), geometry::in_single_precision(s.radius)};
    }
    for (Element& e : elements.shaped()) {
        e.pose.translation = geometry::in_single_precision(e.pose.translation);
        e.pose.rotation = e.pose.rotation == Pose{}.rotation ? e.pose.rotation : rounded(e.pose.rotation);
        e.half = geometry::in_single_precision(e.half);
        e.radius = geometry::in_single_precision(e.radius);
        if (e.hull) {
            std::vector<Vec3> vertices;
            for (const Vec3& vertex : e.hull->surface.vertices) {
                vertices.push_back(geometry::in_single_precision(vertex));
            }
            e.hull = convex_hull(vertices);
        }
    }
    return elements;
}

} // namespace foam::runtime
