// The table of the kinds of elements, and what is the same for all of them.
#include "convex/kind.hpp"

#include <foam/base/error.hpp>

#include <algorithm>
#include <array>

namespace foam::inline geometry {

// Each is in the file of its core: swept_box.cpp, cylinder.cpp, hull.cpp, ellipsoid.cpp.
extern const ConvexKind* const sphere_kind;
extern const ConvexKind* const capsule_kind;
extern const ConvexKind* const cylinder_kind;
extern const ConvexKind* const box_kind;
extern const ConvexKind* const swept_box_kind;
extern const ConvexKind* const hull_kind;
extern const ConvexKind* const ellipsoid_kind;

namespace {

/// By Element::Kind. Addresses of constants: the table is there before anything runs.
constexpr std::array kinds{&sphere_kind,    &capsule_kind, &cylinder_kind, &box_kind,
                           &swept_box_kind, &hull_kind,    &ellipsoid_kind};
static_assert(kinds.size() == element_kinds);

/// Largest difference of R Rᵀ from the identity.
constexpr double orthonormal = 1e-6;

const ConvexKind& in_table(Element::Kind kind) {
    return **kinds[static_cast<std::size_t>(kind)];
}

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

/// Returns whether the sizes that the kind does not use are 0: a proof would take a box with a radius for a swept box.
bool only_own_sizes(const Element& e) {
    const ConvexKind& kind = kind_of(e);
    const bool all = kind.has("size") || kind.has("radii");
    return (all || (e.half.x == 0 && e.half.y == 0)) && (all || kind.has("length") || e.half.z == 0) &&
           (kind.has("radius") || e.radius == 0);
}

} // namespace

const ConvexKind& kind_of(const Element& element) {
    return in_table(element.kind);
}

bool ConvexKind::has(std::string_view number) const {
    return std::find(numbers_.begin(), numbers_.end(), number) != numbers_.end();
}

double ConvexKind::added_volume(const Element& e, std::span<const Vec3> points) const {
    return volume(enlarged(e, points, 0)) - volume(e);
}

bool ConvexKind::erode(Element&, double) const {
    return false;
}

bool ConvexKind::holds_ball(const Element& e, const Vec3& p, double radius) const {
    return signed_distance(e, p) <= -radius;
}

bool Element::operator==(const Element& other) const {
    const bool same_hull = hull == other.hull || (hull && other.hull && *hull == *other.hull);
    return kind == other.kind && pose == other.pose && half == other.half && radius == other.radius && same_hull;
}

std::vector<Element::Kind> every_kind() {
    std::vector<Element::Kind> all;
    for (std::size_t i = 0; i < element_kinds; ++i) {
        all.push_back(static_cast<Element::Kind>(i));
    }
    return all;
}

const char* to_string(Element::Kind kind) {
    return in_table(kind).word();
}

std::optional<Element::Kind> element_kind_named(std::string_view word) {
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        if (word == (*kinds[i])->word()) {
            return static_cast<Element::Kind>(i);
        }
    }
    return {};
}

std::span<const std::string_view> number_names(Element::Kind kind) {
    return in_table(kind).numbers();
}

bool is_valid(const Element& e) {
    if (!is_finite(e.pose.translation) || !is_rotation(e.pose.rotation) || !is_length(e.radius) ||
        !is_length(e.half.x) || !is_length(e.half.y) || !is_length(e.half.z) ||
        (e.hull != nullptr) != (e.kind == Element::Kind::hull) || !only_own_sizes(e)) {
        return false;
    }
    const double size = volume(e);
    return size > 0 && std::isfinite(size);
}

double signed_distance(const Element& e, const Vec3& point) {
    return kind_of(e).signed_distance(e, to_own_frame(e, point));
}

bool holds(const Element& e, const Vec3& point, double slack) {
    return signed_distance(e, point) <= -slack;
}

double distance(const Element& e, const Vec3& point) {
    return std::max(0.0, signed_distance(e, point));
}

Vec3 support(const Element& e, const Vec3& direction) {
    return e.pose * kind_of(e).support(e, turned_back(e, direction));
}

Box bounds(const Element& e) {
    return kind_of(e).bounds(e);
}

double widening(const Element& e) {
    return kind_of(e).is_widened() ? e.radius : 0;
}

double volume(const Element& e) {
    return kind_of(e).volume(e);
}

double thickness(const Element& e) {
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 along{};
        along[axis] = 1;
        least = std::min(least, kind_of(e).support(e, along)[axis] - kind_of(e).support(e, -along)[axis]);
    }
    return least;
}

std::optional<LinePart> inside_along(const Element& e, const Vec3& origin, const Vec3& direction) {
    return kind_of(e).inside_along(e, to_own_frame(e, origin), turned_back(e, direction));
}

Mesh enclosing_mesh(const Element& e, int segments) {
    if (segments < 3) {
        throw Error(ErrorCode::usage, "enclosing_mesh needs at least 3 segments");
    }
    return transformed(kind_of(e).mesh(e, segments), e.pose);
}

std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) {
    std::vector<ElementPoint> points = kind_of(e).surface_points(e, count);
    for (ElementPoint& p : points) {
        p.point = e.pose * p.point;
        p.normal = e.pose.rotate(p.normal);
    }
    return points;
}

Element grown(const Element& e, double length) {
    return length > 0 ? kind_of(e).grown(e, length, [](double a, double b) { return a + b; }) : e;
}

Element enlarged(const Element& e, std::span<const Vec3> points, double room) {
    return kind_of(e).enlarged(e, points, room);
}

double added_volume(const Element& e, std::span<const Vec3> points) {
    return kind_of(e).added_volume(e, points);
}

Element moved(Element element, const Pose& pose) {
    element.pose = pose * element.pose;
    return element;
}

} // namespace foam::inline geometry
