#include "primitive.hpp"

#include <foam/base/error.hpp>

#include <numbers>
#include <string>

namespace foam::inline geometry {
namespace {

using MaybeInterval = std::optional<Solid::Interval>;

MaybeInterval intersection(const MaybeInterval& a, const MaybeInterval& b) {
    if (!a || !b) {
        return {};
    }
    const Solid::Interval both{std::max(a->enter, b->enter), std::min(a->leave, b->leave)};
    return both.enter < both.leave ? MaybeInterval(both) : MaybeInterval();
}

/// Returns the smallest interval that contains both; exact here, as the pieces of a convex solid overlap or touch along
/// a line.
MaybeInterval hull(const MaybeInterval& a, const MaybeInterval& b) {
    if (!a || !b) {
        return a ? a : b;
    }
    return Solid::Interval{std::min(a->enter, b->enter), std::max(a->leave, b->leave)};
}

/// Returns where |o + t d| <= half.
MaybeInterval in_slab(double o, double d, double half) {
    if (d == 0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return std::abs(o) <= half ? MaybeInterval(Solid::Interval{-infinity, infinity}) : MaybeInterval();
    }
    const double t1 = (-half - o) / d, t2 = (half - o) / d;
    return Solid::Interval{std::min(t1, t2), std::max(t1, t2)};
}

/// Returns where a t² + 2 b t + c <= 0, a >= 0.
MaybeInterval in_quadric(double a, double b, double c) {
    if (a == 0) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        return c <= 0 ? MaybeInterval(Solid::Interval{-infinity, infinity}) : MaybeInterval();
    }
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) {
        return {};
    }
    const double q = std::sqrt(discriminant);
    return Solid::Interval{(-b - q) / a, (-b + q) / a};
}

MaybeInterval in_ball(const Vec3& o, const Vec3& d, double radius) {
    return in_quadric(squared_norm(d), dot(o, d), squared_norm(o) - radius * radius);
}

MaybeInterval in_tube(const Vec3& o, const Vec3& d, double radius) {
    return in_quadric(d.x * d.x + d.y * d.y, o.x * d.x + o.y * d.y, o.x * o.x + o.y * o.y - radius * radius);
}

} // namespace

PrimitivePart::PrimitivePart(const Primitive& primitive, const Pose& pose)
    : primitive_(primitive), to_local_(pose.inverse()) {}

double PrimitivePart::signed_distance(const Vec3& p) const {
    const Vec3 q = to_local_ * p;
    const double across = std::hypot(q.x, q.y);
    switch (primitive_.kind) {
    case Primitive::Kind::sphere:
        return norm(q) - primitive_.radius;
    case Primitive::Kind::capsule: {
        const double half = primitive_.length / 2;
        return std::hypot(across, q.z - std::clamp(q.z, -half, half)) - primitive_.radius;
    }
    case Primitive::Kind::cylinder: {
        const double radial = across - primitive_.radius, axial = std::abs(q.z) - primitive_.length / 2;
        return std::min(std::max(radial, axial), 0.0) + std::hypot(std::max(radial, 0.0), std::max(axial, 0.0));
    }
    case Primitive::Kind::box:
        break;
    }
    const Vec3 d{std::abs(q.x) - primitive_.size.x / 2, std::abs(q.y) - primitive_.size.y / 2,
                 std::abs(q.z) - primitive_.size.z / 2};
    return std::min(std::max({d.x, d.y, d.z}), 0.0) +
           norm({std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)});
}

double PrimitivePart::volume() const {
    using std::numbers::pi;
    const double r = primitive_.radius;
    switch (primitive_.kind) {
    case Primitive::Kind::sphere:
        return 4.0 / 3 * pi * r * r * r;
    case Primitive::Kind::capsule:
        return pi * r * r * (primitive_.length + 4.0 / 3 * r);
    case Primitive::Kind::cylinder:
        return pi * r * r * primitive_.length;
    case Primitive::Kind::box:
        break;
    }
    return primitive_.size.x * primitive_.size.y * primitive_.size.z;
}

std::optional<Solid::Interval> PrimitivePart::inside_along(const Vec3& origin, const Vec3& direction) const {
    const Vec3 o = to_local_ * origin, d = to_local_.rotate(direction);
    const double r = primitive_.radius, half = primitive_.length / 2;
    switch (primitive_.kind) {
    case Primitive::Kind::sphere:
        return in_ball(o, d, r);
    case Primitive::Kind::cylinder:
        return intersection(in_tube(o, d, r), in_slab(o.z, d.z, half));
    case Primitive::Kind::capsule:
        return hull(intersection(in_tube(o, d, r), in_slab(o.z, d.z, half)),
                    hull(in_ball(o - Vec3{0, 0, half}, d, r), in_ball(o + Vec3{0, 0, half}, d, r)));
    case Primitive::Kind::box:
        break;
    }
    return intersection(
        in_slab(o.x, d.x, primitive_.size.x / 2),
        intersection(in_slab(o.y, d.y, primitive_.size.y / 2), in_slab(o.z, d.z, primitive_.size.z / 2)));
}

void check_primitive(const Primitive& primitive) {
    const auto check = [&](const char* name, double value, bool zero_allowed) {
        if (!std::isfinite(value) || value < 0 || (value == 0 && !zero_allowed)) {
            throw Error(ErrorCode::geometry,
                        std::string("a collision primitive has a ") + name +
                            " that is not a finite length above zero; correct it in the robot file");
        }
    };
    if (primitive.kind == Primitive::Kind::box) {
        check("box size", primitive.size.x, false);
        check("box size", primitive.size.y, false);
        check("box size", primitive.size.z, false);
        return;
    }
    check("radius", primitive.radius, false);
    if (primitive.kind != Primitive::Kind::sphere) {
        check("length", primitive.length, primitive.kind == Primitive::Kind::capsule);
    }
}

} // namespace foam::geometry
