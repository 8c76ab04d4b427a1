#include "convex/kind.hpp"

#include <foam/base/error.hpp>
#include <foam/base/hypot.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/internal/single_precision.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace foam::inline geometry {
namespace {

constexpr double least_length = std::numeric_limits<double>::min();

/// Returns a number that is above the exact product of 1 + n rounding errors.
double rounded_up(double value, int roundings = 4) {
    return value * (1 + roundings * std::numeric_limits<double>::epsilon()) + least_length;
}

/// Returns a length that no point of the element, seen from its own centre, exceeds.
double reach_of(const Element& element) {
    return rounded_up(norm(element.half) + element.radius);
}

/// Returns the polytope's vertices, each moved so that every plane through it moves outwards by at least `length`. The
/// hull of them contains the polytope and all within `length` of it: in each direction that is a sum of normals of
/// planes through a vertex, its support grows by `length` times the sum of the weights, which is at least 1.
std::vector<Vec3> pushed_out(const Polytope& polytope, double length) {
    const Mesh& mesh = polytope.surface;
    std::vector<std::vector<Vec3>> normals(mesh.vertices.size());
    for (const Triangle& t : mesh.triangles) {
        const Vec3& a = mesh.vertices[t[0]];
        const Vec3 normal = normalized(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
        for (const std::uint32_t corner : t) {
            normals[corner].push_back(normal);
        }
    }
    std::vector<Vec3> result = mesh.vertices;
    for (std::size_t v = 0; v < result.size(); ++v) {
        // The centre c of the smallest ball around unit vectors n has n · c >= |c|².
        const Vec3 c = minimum_enclosing_sphere(normals[v]).center;
        double least = squared_norm(c);
        for (const Vec3& n : normals[v]) {
            least = std::min(least, dot(n, c));
        }
        if (least > 1e-12) { // a needle's tip: the check of the result decides
            result[v] += c * (length / least);
        }
    }
    return result;
}

double farthest_coordinate(const std::vector<Vec3>& points) {
    double largest = 0;
    for (const Vec3& p : points) {
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    return largest;
}

bool all_single_precision(const std::vector<Vec3>& points) {
    return std::all_of(points.begin(), points.end(), [](const Vec3& p) { return in_single_precision(p) == p; });
}

/// Returns the place that vertices are relative to: the link's origin, or their middle if that is farther than eight
/// times their extent, where single precision would be coarse.
Vec3 origin_of(const std::vector<Vec3>& points) {
    Box box;
    for (const Vec3& p : points) {
        box.add(p);
    }
    return norm(box.center()) > 8 * box.diagonal() ? box.center() : Vec3{};
}

Element hull_with_origin(const Vec3& place, std::shared_ptr<const Polytope> polytope) {
    Element result{.kind = Element::Kind::hull};
    result.pose.translation = place;
    result.hull = std::move(polytope);
    return result;
}

/// Returns the element, or one around it whose rotation is orthonormal to rounding: is_valid() allows for more.
Element without_skew(const Element& element) {
    double skew = 0;
    for (std::size_t row = 0; row < 3; ++row) {
        const Vec3 &a = element.pose.rotation[row], &b = element.pose.rotation[(row + 1) % 3];
        skew = std::max({skew, std::abs(dot(a, a) - 1), std::abs(dot(a, b))});
    }
    return skew < 1e-14 ? element
                        : stated_at(element, from_quaternion(element.pose.translation, quaternion(element.pose)));
}

} // namespace

Element stated_at(Element element, const Pose& pose) {
    double turned = 0;
    for (std::size_t row = 0; row < 3; ++row) {
        turned += squared_norm(pose.rotation[row] - element.pose.rotation[row]);
    }
    double moved = norm(pose.translation - element.pose.translation);
    element.pose = pose;
    if (turned == 0 && moved == 0) {
        return element;
    }
    // The Frobenius norm bounds how far a unit vector moves; the reader's rotation is orthonormal only to rounding.
    moved = rounded_up(rounded_up(std::sqrt(turned)) * reach_of(element) + moved);
    if (element.kind == Element::Kind::hull) {
        throw Error(ErrorCode::internal, "stated_at: a hull has no sizes that could grow");
    }
    return kind_of(element).grown(element, moved, [](double size, double more) { return rounded_up(size + more); });
}

std::vector<Element> capsule_parts(const Element& given) {
    const Element capsule = without_skew(given);
    Element cylinder = capsule;
    cylinder.kind = Element::Kind::cylinder;
    cylinder.half.z = rounded_up(capsule.half.z + 1e-5 * capsule.radius);
    std::vector<Element> parts{cylinder};
    for (const double side : {-1.0, 1.0}) {
        Element ball{.kind = Element::Kind::sphere};
        ball.pose.translation = capsule.pose * Vec3{0, 0, side * capsule.half.z};
        // Its centre is rounded: three products and their sum.
        const double rounding =
            8 * std::numeric_limits<double>::epsilon() * (norm(capsule.pose.translation) + capsule.half.z);
        ball.radius = rounded_up(capsule.radius + rounding);
        parts.push_back(ball);
    }
    return parts;
}

/// Returns the capsule of a cylinder and two spheres at its ends, as capsule_parts() and people write it; nothing for
/// others. It lies in the three: what rounding moved the spheres off the axis is taken from its radius.
static std::optional<Element> capsule_of(const Element& cylinder, const Element& one, const Element& other) {
    constexpr double overlap = 2e-5; // of the radius: capsule_parts() makes half of it
    const double same =
        32 * std::numeric_limits<double>::epsilon() * (norm(cylinder.pose.translation) + reach_of(cylinder));
    Element capsule = cylinder;
    capsule.kind = Element::Kind::capsule;
    double upper = 0, lower = 0;
    for (const Element* ball : {&one, &other}) {
        const Vec3 place = cylinder.pose.inverse() * ball->pose.translation;
        const double off = foam::hypot(place.x, place.y);
        const double beyond = std::abs(place.z) - cylinder.half.z;
        if (std::abs(ball->radius - cylinder.radius) > same || off > same || beyond > same ||
            beyond < -overlap * cylinder.radius) {
            return {};
        }
        (place.z > 0 ? upper : lower) = place.z;
        capsule.radius = std::min(capsule.radius, ball->radius - off);
    }
    capsule.half.z = std::min({upper, -lower, cylinder.half.z});
    constexpr double rounding = 1e-9; // of the radius: more is lost far from the origin
    return capsule.half.z > 0 && capsule.radius > (1 - rounding) * cylinder.radius ? std::optional(capsule) : std::nullopt;
}

Elements with_joined_capsules(std::span<const Element> elements) {
    const auto joined = [&](std::size_t at) -> std::optional<Element> {
        for (std::size_t i = 0; i < 3 && at + 3 <= elements.size(); ++i) {
            const Element &cylinder = elements[at + i], &one = elements[at + (i + 1) % 3],
                          &other = elements[at + (i + 2) % 3];
            if (cylinder.kind == Element::Kind::cylinder && one.kind == Element::Kind::sphere &&
                other.kind == Element::Kind::sphere) {
                return capsule_of(cylinder, one, other);
            }
        }
        return {};
    };
    Elements result;
    for (std::size_t at = 0; at < elements.size();) {
        const std::optional<Element> capsule = joined(at);
        result.add(capsule ? *capsule : elements[at]);
        at += capsule ? 3 : 1;
    }
    return result;
}

Element enclosing_hull(const Element& element, int segments) {
    if (element.kind == Element::Kind::hull) {
        return element;
    }
    // Rounding of the mesh's corners is paid for in advance.
    const double rounding =
        64 * std::numeric_limits<double>::epsilon() * (norm(element.pose.translation) + reach_of(element));
    return hull_with_origin({}, convex_hull(enclosing_mesh(grown(without_skew(element), rounding), segments).vertices));
}

Element float32_hull(const Element& hull) {
    const std::vector<Vec3>& own = hull.hull->surface.vertices;
    if (hull.pose.rotation == Pose{}.rotation && all_single_precision(own)) {
        return hull;
    }
    std::vector<Vec3> points;
    for (const Vec3& p : own) {
        points.push_back(hull.pose * p);
    }
    const Vec3 place = origin_of(points);
    for (Vec3& p : points) {
        p = p - place;
    }
    const double far = norm(hull.pose.translation) + farthest_coordinate(own);
    if (farthest_coordinate(points) > 1e38) {
        throw Error(ErrorCode::geometry, "a hull extends farther than single precision can state; remedy: other units");
    }
    const auto polytope = convex_hull(points);
    for (double safety = 1; safety < 1e6; safety *= 4) {
        const double moved =
            safety * (std::numeric_limits<float>::epsilon() * farthest_coordinate(points) +
                      16 * std::numeric_limits<double>::epsilon() * far + std::numeric_limits<float>::denorm_min());
        std::vector<Vec3> rounded = pushed_out(*polytope, moved);
        for (Vec3& p : rounded) {
            p = in_single_precision(p);
        }
        const Element result = hull_with_origin(place, convex_hull(rounded));
        if (std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return holds(result, place + p); })) {
            return result;
        }
    }
    throw Error(ErrorCode::geometry,
                "a hull is so thin that single precision cannot state one around it; remedy: a box, or a thicker hull");
}

std::shared_ptr<const Polytope> hull_if_convex(const Mesh& mesh) {
    const Mesh surface = welded(mesh);
    if (surface.triangles.empty() || !topology(surface).closed()) {
        return nullptr;
    }
    const Pose home{.translation = -surface.vertices.front()}; // digits cancel in volumes far from the origin
    try {
        auto hull = convex_hull(surface.vertices);
        const double own = std::abs(signed_volume(transformed(surface, home))),
                     of_hull = signed_volume(transformed(hull->surface, home));
        return of_hull - own <= 1e-9 * of_hull ? hull : nullptr;
    } catch (const Error&) { // the corners lie in a plane
        return nullptr;
    }
}

} // namespace foam::geometry
