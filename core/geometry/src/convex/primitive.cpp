#include "convex/primitive.hpp"

#include "convex/convex_line.hpp"

#include <foam/base/error.hpp>

#include <numbers>
#include <string>

namespace foam::inline geometry {

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
    const MaybePart part = primitive_.kind == Primitive::Kind::sphere     ? in_ball(o, d, r)
                           : primitive_.kind == Primitive::Kind::cylinder ? in_cylinder(o, d, r, half)
                           : primitive_.kind == Primitive::Kind::capsule  ? in_capsule(o, d, r, half)
                                                                          : in_box(o, d, primitive_.size / 2);
    return part ? std::optional(Solid::Interval{part->enter, part->leave}) : std::nullopt;
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

} // namespace foam::inline geometry
