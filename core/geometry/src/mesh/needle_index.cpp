#include "mesh/needle_index.hpp"

namespace foam::inline geometry {
namespace {

/// Ratio of the area of all triangles' boxes to that of the mesh's box. In usual meshes the sum is a few times the
/// box's area.
constexpr double most_area = 100;

double half_area(const Box& box) {
    const Vec3 size = box.size();
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

Box box_of(const Corners& t) {
    Box box;
    box.add(t.a);
    box.add(t.b);
    box.add(t.c);
    return box;
}

/// Returns the longest edge of all, and the edge of that triangle that begins at the same corner.
std::array<Vec3, 2> longest_edge(std::span<const Corners> triangles) {
    double longest = 0;
    std::array<Vec3, 2> sides{};
    for (const Corners& t : triangles) {
        for (const auto& [a, b, c] : {std::array{t.a, t.b, t.c}, std::array{t.b, t.c, t.a}, std::array{t.c, t.a, t.b}}) {
            if (const double length = squared_norm(b - a); length > longest) {
                longest = length;
                sides = {b - a, c - a};
            }
        }
    }
    return sides;
}

/// Returns an orthonormal frame: along the first side, across it in the triangle's plane, along the normal.
std::array<Vec3, 3> frame_of(const std::array<Vec3, 2>& sides) {
    const Vec3 along = normalized(sides[0]);
    Vec3 normal = normalized(cross(along, sides[1]));
    if (normal == Vec3{}) { // a triangle without area
        const Vec3 other = std::abs(along.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        normal = normalized(cross(along, other));
    }
    return {along, cross(normal, along), normal};
}

} // namespace

bool NeedleIndex::pays(std::span<const Box> boxes, const Box& all) {
    double area = 0;
    for (const Box& box : boxes) {
        area += half_area(box);
    }
    return area > most_area * half_area(all);
}

NeedleIndex::NeedleIndex(std::span<const Corners> triangles, const Vec3& center)
    : center_(center), axes_(frame_of(longest_edge(triangles))) {
    std::vector<Box> boxes;
    Box all;
    boxes.reserve(triangles.size());
    for (const Corners& t : triangles) {
        boxes.push_back(box_of({turned(t.a - center), turned(t.b - center), turned(t.c - center)}));
        all.add(boxes.back());
    }
    index_ = PartIndex(boxes, all);
}

} // namespace foam::geometry
