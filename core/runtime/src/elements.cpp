#include <foam/runtime/internal/elements.hpp>

#include <algorithm>
#include <limits>
#include <memory>

namespace foam::inline runtime {
namespace {

double single(double value) {
    return static_cast<double>(static_cast<float>(value));
}

Vec3 single(const Vec3& v) {
    return {single(v.x), single(v.y), single(v.z)};
}

/// Returns the rotation with numbers in single precision, orthonormal to double precision again.
std::array<Vec3, 3> single(const std::array<Vec3, 3>& rotation) {
    const Vec3 x = normalized(single(rotation[0]));
    const Vec3 y = single(rotation[1]);
    const Vec3 across = normalized(y - x * dot(x, y));
    return {x, across, cross(x, across)};
}

double reach_beyond(const ClipPlane& plane, const Element& element) {
    const Vec3 normal = normalized(plane.normal);
    return dot(normal, support(element, normal)) - plane.offset;
}

double reach_beyond(const ClipPlane& plane, const ElementsView& elements) {
    double reach = foam::reach_beyond(plane, elements.spheres);
    for (const Element& element : elements.others) {
        reach = std::max(reach, reach_beyond(plane, element));
    }
    return reach;
}

} // namespace

Approximation::Level level_of(const ElementsView& elements) {
    return {.spheres = {elements.spheres.begin(), elements.spheres.end()},
            .parents = {},
            .others = {elements.others.begin(), elements.others.end()}};
}

void append(Approximation::Level& level, const ElementsView& more) {
    level.spheres.insert(level.spheres.end(), more.spheres.begin(), more.spheres.end());
    level.others.insert(level.others.end(), more.others.begin(), more.others.end());
}

Approximation::Level moved(Approximation::Level level, const Pose& pose) {
    for (Sphere& sphere : level.spheres) {
        sphere.center = pose * sphere.center;
    }
    for (Element& element : level.others) {
        element = geometry::moved(std::move(element), pose);
    }
    return level;
}

Approximation moved(Approximation approximation, const Pose& pose) {
    for (Approximation::Level& level : approximation.levels) {
        level = moved(std::move(level), pose);
    }
    return approximation;
}

void add_elements(Panel& panel, const ElementsView& elements, const Pose& pose) {
    for (const Sphere& sphere : elements.spheres) {
        panel.spheres.push_back({pose * sphere.center, sphere.radius});
    }
    for (const Element& element : elements.others) {
        panel.meshes.push_back({std::make_shared<const Mesh>(enclosing_mesh(element)), pose, true});
    }
}

Approximation::Level in_single_precision(Approximation::Level level) {
    for (Sphere& s : level.spheres) {
        s = {single(s.center), single(s.radius)};
    }
    for (Element& e : level.others) {
        e.pose.translation = single(e.pose.translation);
        e.pose.rotation = e.pose.rotation == Pose{}.rotation ? e.pose.rotation : single(e.pose.rotation);
        e.half = single(e.half);
        e.radius = single(e.radius);
        if (e.hull) {
            std::vector<Vec3> vertices;
            for (const Vec3& vertex : e.hull->surface.vertices) {
                vertices.push_back(single(vertex));
            }
            e.hull = convex_hull(vertices);
        }
    }
    return level;
}

double violation_of(const std::vector<ClipPlane>& planes, const ElementsView& elements) {
    if (elements.others.empty()) {
        return foam::violation_of(planes, elements.spheres);
    }
    double worst = -std::numeric_limits<double>::infinity();
    for (const PlaneReach& plane : reached(planes, elements)) {
        worst = std::max(worst, plane.reached - plane.plane.reach);
    }
    return worst;
}

std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, const ElementsView& elements) {
    std::vector<PlaneReach> result;
    for (const ClipPlane& plane : planes) {
        result.push_back({plane, reach_beyond(plane, elements)});
    }
    return result;
}

} // namespace foam::runtime
