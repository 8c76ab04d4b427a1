// A rod of needles at an angle to the axes: axis-aligned boxes of its triangles tell little.
#pragma once

#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace foam::test::needles {

inline constexpr double rod_length = 100, rod_radius = 1;
inline const Vec3 along = normalized(Vec3{4, -8, 1});
inline const Vec3 across = normalized(cross(along, Vec3{0, 0, 1}));
inline const Vec3 third = cross(along, across);
inline const Vec3 rod_middle{300, -200, 50};

inline Vec3 placed(double x, double y, double z) {
    return rod_middle + along * x + across * y + third * z;
}

/// A prism of 400 sides, closed, of which each side is two needles from end to end.
inline Mesh rod() {
    constexpr std::uint32_t sides = 400;
    Mesh mesh;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        mesh.vertices.push_back(placed(-rod_length / 2, rod_radius * std::cos(angle), rod_radius * std::sin(angle)));
        mesh.vertices.push_back(placed(rod_length / 2, rod_radius * std::cos(angle), rod_radius * std::sin(angle)));
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
        mesh.triangles.push_back({a, a + 1, b});
        mesh.triangles.push_back({b, a + 1, b + 1});
        if (i >= 2) {
            mesh.triangles.push_back({0, a, 2 * (i - 1)});
            mesh.triangles.push_back({1, 2 * (i - 1) + 1, a + 1});
        }
    }
    return mesh;
}

inline std::vector<geometry::Corners> corners_of(const Mesh& mesh) {
    std::vector<geometry::Corners> corners;
    for (const auto& [a, b, c] : mesh.triangles) {
        corners.push_back({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]});
    }
    return corners;
}

} // namespace foam::test::needles
