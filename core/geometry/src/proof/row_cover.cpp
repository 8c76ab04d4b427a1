#include <foam/base/hypot.hpp>
#include <foam/geometry/row_cover.hpp>

#include <numbers>

namespace foam::inline geometry {
namespace {

/// Returns the distance of the farthest vertex of the surface from the primitive's axis, or from the segment within a
/// capsule.
double outermost(const Solid& solid, const Element& primitive, const Pose& to_local) {
    double farthest = 0;
    for (const Vec3& vertex : solid.surface().vertices) {
        const Vec3 p = to_local * vertex;
        const double half = primitive.half.z;
        const double along = primitive.kind == Element::Kind::capsule ? p.z - std::clamp(p.z, -half, half) : 0;
        farthest = std::max(farthest, std::hypot(p.x, p.y, along));
    }
    return farthest;
}

} // namespace

double BallRow::volume() const {
    using std::numbers::pi;
    const double r = radius, h = half_spacing, cap = r - h;
    const double zone = 2 * pi * h * (r * r - h * h / 3);
    return static_cast<double>(count) * zone + 2 * pi * cap * cap * (r - cap / 3);
}

BallRow row_around_cylinder(double radius, double length, std::size_t count) {
    const double h = length / (2 * static_cast<double>(count));
    return {count, foam::hypot(radius, h), h};
}

BallRow row_around_capsule(double radius, double length, std::size_t count) {
    const double reach = radius + length / 2;
    if (count == 1) {
        return {1, reach, 0};
    }
    // √(radius² + h²) = reach - k h, the smaller root of h² (k² - 1) - 2 reach k h + reach² - radius² = 0, in the form
    // that does not cancel.
    const double k = static_cast<double>(count - 1);
    const double h =
        (reach * reach - radius * radius) / (k * reach + std::sqrt(reach * reach + (k * k - 1) * radius * radius));
    return {count, reach - k * h, h};
}

std::optional<std::vector<Sphere>> row_cover(const Solid& solid, std::size_t most) {
    const Solid::Part& part = solid.parts().front();
    if (solid.parts().size() > 1 || !part.primitive || most == 0) {
        return {};
    }
    const Element& primitive = *part.primitive;
    const bool capsule = primitive.kind == Element::Kind::capsule;
    if (!capsule && primitive.kind != Element::Kind::cylinder) {
        return {};
    }
    // Proofs then need not subdivide finely where balls meet.
    constexpr double aside = 1 + 1e-4;
    const double radius = outermost(solid, primitive, part.pose.inverse()) * aside;
    const double length = 2 * primitive.half.z * aside;
    BallRow best;
    for (std::size_t count = 1; count <= most; ++count) {
        const BallRow row =
            capsule ? row_around_capsule(radius, length, count) : row_around_cylinder(radius, length, count);
        best = count == 1 || row.volume() < best.volume() ? row : best;
    }
    std::vector<Sphere> balls;
    for (std::size_t i = 0; i < best.count; ++i) {
        const double z = (2 * static_cast<double>(i) - static_cast<double>(best.count - 1)) * best.half_spacing;
        balls.push_back({part.pose * Vec3{0, 0, z}, best.radius * aside});
    }
    return balls;
}

} // namespace foam::geometry
