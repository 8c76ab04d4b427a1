#include <foam/geometry/element.hpp>

#include "convex/outside_box.hpp"

#include <array>
#include <numbers>

namespace foam::inline geometry {
namespace {

constexpr std::array<const char*, element_kinds> words{"sphere", "capsule", "cylinder", "box", "swept_box", "hull"};
/// Largest difference of R Rᵀ from the identity.
constexpr double orthonormal = 1e-6;

bool is_length(double value) {
    return std::isfinite(value) && value >= 0;
}

bool is_rotation(const std::array<Vec3, 3>& rows) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = i; k < 3; ++k) {
            if (!(std::abs(dot(rows[i], rows[k]) - (i == k ? 1 : 0)) <= orthonormal)) {
                return false;
            }
        }
    }
    return dot(cross(rows[0], rows[1]), rows[2]) > 0;
}

/// Returns Rᵀ v.
Vec3 turned_back(const Pose& pose, const Vec3& v) {
    const auto& r = pose.rotation;
    return r[0] * v.x + r[1] * v.y + r[2] * v.z;
}

/// Returns the point of a box's core in a direction.
Vec3 corner_towards(const Vec3& half, const Vec3& d) {
    return {std::copysign(half.x, d.x), std::copysign(half.y, d.y), std::copysign(half.z, d.z)};
}

Vec3 support_of_hull(const Polytope& hull, const Vec3& d) {
    Vec3 best = hull.surface.vertices.front();
    double farthest = dot(best, d);
    for (const Vec3& v : hull.surface.vertices) {
        const double far = dot(v, d);
        if (far > farthest) {
            farthest = far;
            best = v;
        }
    }
    return best;
}

double distance_to_planes(const Polytope& hull, const Vec3& p) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Polytope::Face& face : hull.faces) {
        farthest = std::max(farthest, dot(face.normal, p) - face.offset);
    }
    return farthest;
}

/// Returns how far the point is outside, negative inside. Outside it is the distance, as distance() says; inside, the
/// largest slack with which the element holds the point.
double signed_distance(const Element& e, const Vec3& p) {
    const Vec3 q = turned_back(e.pose, p - e.pose.translation);
    switch (e.kind) {
    case Element::Kind::sphere:
        return norm(q) - e.radius;
    case Element::Kind::capsule:
        return norm(outside_box({0, 0, e.half.z}, q)) - e.radius;
    case Element::Kind::cylinder: {
        const double across = std::hypot(q.x, q.y) - e.radius, along = std::abs(q.z) - e.half.z;
        return std::max(across, along) <= 0 ? std::max(across, along)
                                            : std::hypot(std::max(across, 0.0), std::max(along, 0.0));
    }
    case Element::Kind::hull:
        return distance_to_planes(*e.hull, q);
    case Element::Kind::box:
    case Element::Kind::swept_box:
        break;
    }
    const Vec3 out = outside_box(e.half, q);
    if (out != Vec3{}) {
        return norm(out) - e.radius;
    }
    const Vec3 d{std::abs(q.x) - e.half.x, std::abs(q.y) - e.half.y, std::abs(q.z) - e.half.z};
    return std::max({d.x, d.y, d.z}) - e.radius;
}

} // namespace

bool Element::operator==(const Element& other) const {
    const bool same_hull = hull == other.hull || (hull && other.hull && *hull == *other.hull);
    return kind == other.kind && pose == other.pose && half == other.half && radius == other.radius && same_hull;
}

const char* to_string(Element::Kind kind) {
    return words[static_cast<std::size_t>(kind)];
}

std::optional<Element::Kind> element_kind_named(std::string_view word) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (word == words[i]) {
            return static_cast<Element::Kind>(i);
        }
    }
    return {};
}

/// Returns whether the sizes that the kind does not use are 0: a proof would take a box with a radius for a swept box.
static bool only_own_sizes(const Element& e) {
    using Kind = Element::Kind;
    const bool box = e.kind == Kind::box || e.kind == Kind::swept_box;
    const bool along = box || e.kind == Kind::capsule || e.kind == Kind::cylinder;
    return (box || (e.half.x == 0 && e.half.y == 0)) && (along || e.half.z == 0) &&
           ((e.kind != Kind::box && e.kind != Kind::hull) || e.radius == 0);
}

bool is_valid(const Element& e) {
    if (!is_finite(e.pose.translation) || !is_rotation(e.pose.rotation) || !is_length(e.radius) ||
        !is_length(e.half.x) || !is_length(e.half.y) || !is_length(e.half.z) ||
        (e.hull != nullptr) != (e.kind == Element::Kind::hull)) {
        return false;
    }
    if (!only_own_sizes(e)) {
        return false;
    }
    const double size = volume(e);
    return size > 0 && std::isfinite(size);
}

bool holds(const Element& element, const Vec3& point, double slack) {
    return signed_distance(element, point) <= -slack;
}

double distance(const Element& element, const Vec3& point) {
    return std::max(0.0, signed_distance(element, point));
}

Vec3 support(const Element& e, const Vec3& direction) {
    const Vec3 d = turned_back(e.pose, direction);
    switch (e.kind) {
    case Element::Kind::sphere:
        return e.pose * (normalized(d) * e.radius);
    case Element::Kind::capsule:
        return e.pose * (Vec3{0, 0, std::copysign(e.half.z, d.z)} + normalized(d) * e.radius);
    case Element::Kind::cylinder:
        return e.pose * (Vec3{0, 0, std::copysign(e.half.z, d.z)} + normalized({d.x, d.y, 0}) * e.radius);
    case Element::Kind::hull:
        return e.pose * support_of_hull(*e.hull, d);
    case Element::Kind::box:
    case Element::Kind::swept_box:
        break;
    }
    return e.pose * (corner_towards(e.half, d) + normalized(d) * e.radius);
}

Box bounds(const Element& e) {
    Box box;
    if (e.kind == Element::Kind::hull) {
        for (const Vec3& v : e.hull->surface.vertices) {
            box.add(e.pose * v);
        }
        return box;
    }
    Vec3 reach;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3& row = e.pose.rotation[static_cast<std::size_t>(axis)];
        const double radius =
            e.kind == Element::Kind::cylinder ? e.radius * std::hypot(row.x, row.y) : e.radius * norm(row);
        reach[axis] = std::abs(row.x) * e.half.x + std::abs(row.y) * e.half.y + std::abs(row.z) * e.half.z + radius;
    }
    box.add(e.pose.translation - reach);
    box.add(e.pose.translation + reach);
    return box;
}

double volume(const Element& e) {
    using std::numbers::pi;
    const Vec3& h = e.half;
    const double r = e.radius;
    switch (e.kind) {
    case Element::Kind::sphere:
        return 4.0 / 3 * pi * r * r * r;
    case Element::Kind::capsule:
        return pi * r * r * (2 * h.z + 4.0 / 3 * r);
    case Element::Kind::cylinder:
        return pi * r * r * 2 * h.z;
    case Element::Kind::hull:
        return signed_volume(e.hull->surface);
    case Element::Kind::box:
        return 8 * h.x * h.y * h.z;
    case Element::Kind::swept_box:
        break;
    }
    // Steiner's formula: the box, its faces, its edges and its corners, widened.
    return 8 * h.x * h.y * h.z + 8 * (h.x * h.y + h.y * h.z + h.z * h.x) * r + 2 * pi * (h.x + h.y + h.z) * r * r +
           4.0 / 3 * pi * r * r * r;
}

Element moved(Element element, const Pose& pose) {
    element.pose = pose * element.pose;
    return element;
}

} // namespace foam::geometry
