// Meshes and random things for the tests of geometry that need no other library.
#pragma once

#include <foam/base/random.hpp>
#include <foam/geometry/elements.hpp>
#include <foam/geometry/solid.hpp>

#include <numbers>

namespace foam::test {

inline Mesh box(const Vec3& low, const Vec3& high) {
    Mesh mesh = enclosing_mesh(Element::box(high - low));
    for (Vec3& v : mesh.vertices) {
        v += (low + high) * 0.5;
    }
    return mesh;
}

inline Mesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{a, b, c}, {{0, 1, 2}}};
}

inline Mesh flipped(Mesh mesh) {
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
    return mesh;
}

/// Latitudes and longitudes; the vertices lie on the sphere.
inline Mesh ball(const Vec3& center, double radius, std::uint32_t n = 24) {
    Mesh mesh;
    mesh.vertices.push_back(center + Vec3{0, 0, radius});
    for (std::uint32_t i = 1; i < n; ++i) {
        for (std::uint32_t k = 0; k < 2 * n; ++k) {
            const double polar = std::numbers::pi * i / n, angle = std::numbers::pi * k / n;
            mesh.vertices.push_back(center + radius * Vec3{std::sin(polar) * std::cos(angle),
                                                           std::sin(polar) * std::sin(angle), std::cos(polar)});
        }
    }
    mesh.vertices.push_back(center - Vec3{0, 0, radius});
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (std::uint32_t k = 0; k < 2 * n; ++k) {
        const std::uint32_t next = (k + 1) % (2 * n);
        mesh.triangles.push_back({0, 1 + k, 1 + next});
        for (std::uint32_t i = 0; i + 2 < n; ++i) {
            const std::uint32_t high = 1 + 2 * n * i, low = high + 2 * n;
            mesh.triangles.push_back({high + k, low + k, low + next});
            mesh.triangles.push_back({high + k, low + next, high + next});
        }
        mesh.triangles.push_back({last, last - 2 * n + next, last - 2 * n + k});
    }
    return mesh;
}

inline Mesh together(Mesh a, const Mesh& b) {
    append(a, b);
    return a;
}

/// Every triangle with corners of its own, as in an STL file.
inline Mesh soup(const Mesh& mesh) {
    Mesh result;
    for (const Triangle& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(result.vertices.size());
        for (const std::uint32_t corner : t) {
            result.vertices.push_back(mesh.vertices[corner]);
        }
        result.triangles.push_back({first, first + 1, first + 2});
    }
    return result;
}

inline Vec3 random_point(Random& random, const Box& box) {
    return {random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
            random.uniform(box.low.z, box.high.z)};
}

inline Vec3 random_vector(Random& random, double size) {
    return random_point(random, Box::about({}, {size, size, size}));
}

inline Vec3 random_direction(Random& random) {
    const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * std::numbers::pi);
    const double across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

inline Pose random_pose(Random& random, double range) {
    Pose pose = Pose::from_axis_angle(random_direction(random), random.uniform(0, 6));
    pose.translation = {random.uniform(-range, range), random.uniform(-range, range), random.uniform(-range, range)};
    return pose;
}

inline Box enlarged(Box box, double by) {
    box.low = box.low - Vec3{by, by, by};
    box.high = box.high + Vec3{by, by, by};
    return box;
}

/// Returns the box between two corners, along the link's axes.
inline Element box_between(const Vec3& low, const Vec3& high) {
    Element e = Element::box(high - low);
    e.pose.translation = (low + high) * 0.5;
    return e;
}
inline Element ball_about(const Vec3& center, double radius) {
    return element_of(Sphere{center, radius});
}

/// Returns a sphere, capsule or cylinder; the length is that of the latter two.
inline Element round_element(Element::Kind kind, double radius, double length) {
    Element element{.kind = kind, .radius = radius};
    element.half.z = kind == Element::Kind::sphere ? 0 : length / 2;
    return element;
}

/// Balls along x that meet above 1, 2, ….
inline std::vector<Sphere> row_of_balls(int count, double radius) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < count; ++i) {
        spheres.push_back({{i + 0.5, 0.3, 0}, radius});
    }
    return spheres;
}

inline std::shared_ptr<const Solid> primitive_solid(const Element& primitive, const Pose& pose = {}) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, primitive, pose}});
}

} // namespace foam::test
