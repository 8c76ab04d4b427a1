#include "cloud.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <tuple>

namespace foam::inline search::convex {
namespace {

/// Returns the two farthest of the points from one another, about.
std::pair<Vec3, Vec3> far_apart(const std::vector<Vec3>& points) {
    const auto farthest_from = [&](const Vec3& p) {
        return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
            return squared_norm(a - p) < squared_norm(b - p);
        });
    };
    const Vec3 one = farthest_from(points.front());
    return {one, farthest_from(one)};
}

/// Returns the normal of points that lie in a plane; zero for a line.
Vec3 normal_of_flat(const std::vector<Vec3>& points) {
    const auto [a, b] = far_apart(points);
    Vec3 largest{};
    for (const Vec3& p : points) {
        if (const Vec3 n = cross(b - a, p - a); squared_norm(n) > squared_norm(largest)) {
            largest = n;
        }
    }
    return norm(largest) > thin * squared_norm(b - a) ? normalized(largest) : Vec3{};
}

void set_frame(Cloud& cloud, std::span<const Vec3> points) {
    Box box;
    for (const Vec3& p : points) {
        box.add(p);
    }
    cloud.origin = box.center();
    const double place = norm(cloud.origin);
    cloud.unit = box.diagonal() > 0 ? box.diagonal() : place > 0 ? place : 1; // of a point: its rounding matters
    cloud.points.reserve(points.size());
    for (const Vec3& p : points) {
        cloud.points.push_back(cloud.to_unit(p));
    }
}

void set_normals(Cloud& cloud, const std::vector<geometry::HullTriangle>& triangles) {
    struct Face {
        double area;
        Vec3 normal;
    };
    std::vector<Face> faces;
    for (const geometry::HullTriangle& t : triangles) {
        const auto& [a, b, c] = t.corners;
        const Vec3 n = cross(cloud.points[b] - cloud.points[a], cloud.points[c] - cloud.points[a]);
        if (const double area = norm(n); area > 0) {
            faces.push_back({area, n / area});
        }
    }
    std::stable_sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.area > b.area; });
    constexpr double same = 1 - 1e-9; // cosine of parallel faces
    constexpr std::size_t most = 200;
    for (std::size_t f = 0; f < faces.size() && cloud.normals.size() < most; ++f) {
        const Face& face = faces[f];
        const bool known = std::any_of(cloud.normals.begin(), cloud.normals.end(),
                                       [&](const Vec3& n) { return std::abs(dot(n, face.normal)) > same; });
        if (!known) {
            cloud.normals.push_back(face.normal);
        }
    }
}

} // namespace

/// Makes the hull of the points of a cloud, and sets its normals. Returns nothing of points that lie in a plane.
static std::optional<HullOfPoints> hull_of(Cloud& cloud) {
    constexpr double flat = 1e-9; // units: below this thickness there is no hull to speak of
    const Vec3 normal = normal_of_flat(cloud.points);
    const auto [low, high] =
        std::minmax_element(cloud.points.begin(), cloud.points.end(),
                            [&](const Vec3& a, const Vec3& b) { return dot(a, normal) < dot(b, normal); });
    // What a hull of this precision leaves out, element_of() has room for.
    constexpr double precision = 1e-14;
    if (HullOfPoints hull; dot(*high - *low, normal) > flat && hull.run(cloud.points, precision)) {
        set_normals(cloud, hull.triangles());
        return hull;
    }
    cloud.flat = true;
    if (squared_norm(normal) > 0) {
        cloud.normals.push_back(normal);
    }
    return std::nullopt;
}

Cloud cloud_of(std::span<const Vec3> points) {
    Cloud cloud;
    set_frame(cloud, points);
    if (const std::optional<HullOfPoints> hull = hull_of(cloud)) {
        std::vector<Vec3> vertices;
        for (const std::uint32_t v : hull->vertices()) {
            vertices.push_back(cloud.points[v]);
        }
        // Not in the order in which the points were given: what is made of them hardly depends on it.
        std::sort(vertices.begin(), vertices.end(),
                  [](const Vec3& p, const Vec3& q) { return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z); });
        cloud.points = std::move(vertices);
    }
    return cloud;
}

Cloud quick_cloud_of(std::span<const Vec3> points) {
    Cloud cloud;
    set_frame(cloud, points);
    Cloud coarse;
    coarse.points = few_extremes_of(cloud.points);
    hull_of(coarse);
    cloud.normals = std::move(coarse.normals);
    return cloud;
}

double volume(const Fit& fit) {
    constexpr double pi = std::numbers::pi;
    const Vec3& h = fit.half;
    const double r = fit.radius;
    switch (fit.kind) {
    case Element::Kind::sphere:
        return 4 * pi / 3 * r * r * r;
    case Element::Kind::capsule:
        return 2 * pi * r * r * h.z + 4 * pi / 3 * r * r * r;
    case Element::Kind::cylinder:
        return 2 * pi * r * r * h.z;
    case Element::Kind::box:
        return 8 * h.x * h.y * h.z;
    case Element::Kind::swept_box: // Steiner's formula
        return 8 * h.x * h.y * h.z + 8 * r * (h.x * h.y + h.y * h.z + h.z * h.x) + 2 * pi * r * r * (h.x + h.y + h.z) +
               4 * pi / 3 * r * r * r;
    case Element::Kind::ellipsoid:
        return 4 * pi / 3 * h.x * h.y * h.z;
    case Element::Kind::hull:
        break;
    }
    throw Error(ErrorCode::internal, "a hull has no fit");
}

Element element_of(const Fit& fit, const Cloud& cloud) {
    // A point in units, its rotation and the element's own numbers each have some rounding.
    const double place = std::max({std::abs(cloud.origin.x), std::abs(cloud.origin.y), std::abs(cloud.origin.z)});
    const double spare = 1e-12 * cloud.unit + 16 * std::numeric_limits<double>::epsilon() * place;
    Element element;
    element.kind = fit.kind;
    for (int i = 0; i < 3; ++i) {
        element.pose.rotation[static_cast<std::size_t>(i)] = {fit.axes[0][i], fit.axes[1][i], fit.axes[2][i]};
    }
    element.pose.translation = cloud.origin + fit.center * cloud.unit;
    if (fit.kind == Element::Kind::ellipsoid) {
        element.half = fit.half * cloud.unit;
        return grown(element, spare);
    }
    const bool has_radius = fit.kind != Element::Kind::box;
    const bool has_flat_ends = fit.kind == Element::Kind::box || fit.kind == Element::Kind::cylinder;
    element.radius = has_radius ? fit.radius * cloud.unit + spare : 0;
    element.half = fit.half * cloud.unit;
    if (has_flat_ends) {
        element.half.z += spare;
    }
    if (fit.kind == Element::Kind::box) {
        element.half.x += spare;
        element.half.y += spare;
    }
    return element;
}

Fit fit_of(const Element& element, const Vec3& origin, double unit) {
    Fit fit{.kind = element.kind};
    const auto& rows = element.pose.rotation;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        fit.axes[axis] = {rows[0][static_cast<int>(axis)], rows[1][static_cast<int>(axis)],
                          rows[2][static_cast<int>(axis)]};
    }
    fit.center = (element.pose.translation - origin) / unit;
    fit.half = element.half / unit;
    fit.radius = element.radius / unit;
    return fit;
}

std::array<Vec3, 3> frame_along(const Vec3& z) {
    const Vec3 other = std::abs(z.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 x = normalized(cross(other, z));
    return {x, cross(z, x), z};
}

std::array<Vec3, 3> turned(const std::array<Vec3, 3>& axes, const Vec3& by) {
    const Vec3 w = axes[0] * by.x + axes[1] * by.y + axes[2] * by.z;
    const double angle = norm(w);
    if (!(angle > 0)) {
        return axes;
    }
    const Pose turn = Pose::from_axis_angle(w / angle, angle);
    const Vec3 z = normalized(turn.rotate(axes[2]));
    const Vec3 t = turn.rotate(axes[0]);
    const Vec3 x = normalized(t - z * dot(t, z));
    return {x, cross(z, x), z};
}

} // namespace foam::inline search::convex
