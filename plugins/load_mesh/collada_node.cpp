#include "collada.hpp"

#include <fmt/format.h>

#include <map>
#include <numbers>
#include <span>

namespace foam::load_mesh {
namespace {

using Numbers = std::span<const double>;

Vec3 vector(Numbers n, std::size_t at) {
    return {n[at], n[at + 1], n[at + 2]};
}

Affine matrix(Numbers n) {
    return {{Vec3{n[0], n[1], n[2]}, Vec3{n[4], n[5], n[6]}, Vec3{n[8], n[9], n[10]}}, {n[3], n[7], n[11]}};
}

Affine translate(Numbers n) {
    return Affine::translation(vector(n, 0));
}

Affine scale(Numbers n) {
    return Affine::scaling(vector(n, 0));
}

/// Returns the rotation by an axis and an angle in degrees; the identity without an axis.
Affine rotate(Numbers n) {
    const Vec3 axis = normalized(vector(n, 0));
    return axis == Vec3{} ? Affine{} : Affine::rotation(Pose::from_axis_angle(axis, n[3] * std::numbers::pi / 180));
}

/// Returns the frame of a viewer who looks along -z, from eye, point of interest and up direction.
Affine look_at(Numbers n) {
    const Vec3 eye = vector(n, 0), back = normalized(eye - vector(n, 3)), right = normalized(cross(vector(n, 6), back)),
               up = cross(back, right);
    return {{Vec3{right.x, up.x, back.x}, Vec3{right.y, up.y, back.y}, Vec3{right.z, up.z, back.z}}, eye};
}

/// Returns RenderMan's skew by an angle in degrees: p ↦ p + tan(angle) (p · from) along, with both axes of unit length
/// and `from` made perpendicular to `along`.
Affine skew(Numbers n) {
    const Vec3 along = normalized(vector(n, 4)), turned = vector(n, 1),
               from = normalized(turned - along * dot(turned, along));
    const double slope = std::tan(n[0] * std::numbers::pi / 180);
    Affine result;
    for (int row = 0; row < 3; ++row) {
        result.rows[static_cast<std::size_t>(row)] += from * (slope * along[row]);
    }
    return result;
}

struct Kind {
    std::size_t numbers;
    Affine (*make)(Numbers);
};

} // namespace

Affine transform_of(const ColladaDocument& document, const xml::Element& node) {
    static const std::map<std::string_view, Kind> kinds{{"matrix", {16, matrix}}, {"translate", {3, translate}},
                                                        {"scale", {3, scale}},    {"rotate", {4, rotate}},
                                                        {"lookat", {9, look_at}}, {"skew", {7, skew}}};
    Affine result;
    std::vector<double> numbers;
    for (const auto& child : node.children) {
        const auto kind = kinds.find(child->name);
        if (kind == kinds.end()) {
            continue;
        }
        numbers.clear();
        ElementWords words(document.source(), *child);
        while (const auto number = words.number()) {
            numbers.push_back(*number);
        }
        if (numbers.size() < kind->second.numbers) {
            throw document.error(*child,
                                 fmt::format("<{}> holds {} numbers, {} are needed; remedy: export the mesh again",
                                             child->name, numbers.size(), kind->second.numbers));
        }
        result = result * kind->second.make(numbers);
    }
    return result;
}

} // namespace foam::load_mesh
