// Solids of many kinds, the awkward ones among them.
#pragma once

#include <foam/robot.hpp>
#include <foam/solid.hpp>

#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>

namespace foam::test {

inline Mesh box_mesh(const Vec3& size, const Vec3& center = {}) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.vertices.push_back(
            center + Vec3{(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

inline Mesh torus_mesh(double large, double small, std::uint32_t around = 24, std::uint32_t across = 12) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < around; ++i) {
        for (std::uint32_t k = 0; k < across; ++k) {
            const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * k / across;
            const double reach = large + small * std::cos(b);
            mesh.vertices.push_back({reach * std::cos(a), reach * std::sin(a), small * std::sin(b)});
            const std::uint32_t i1 = (i + 1) % around, k1 = (k + 1) % across;
            mesh.triangles.push_back({i * across + k, i1 * across + k, i1 * across + k1});
            mesh.triangles.push_back({i * across + k, i1 * across + k1, i * across + k1});
        }
    }
    return mesh;
}

/// An L of 0.2 × 0.1 × 0.15 m, 0.05 m thick: the sides of its outline drawn up.
inline Mesh bracket_mesh() {
    Mesh mesh;
    const std::array<std::pair<double, double>, 6> outline{
        {{0, 0}, {0.2, 0}, {0.2, 0.05}, {0.05, 0.05}, {0.05, 0.15}, {0, 0.15}}};
    for (const double y : {0.0, 0.1}) {
        for (const auto& [x, z] : outline) {
            mesh.vertices.push_back({x, y, z});
        }
    }
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t next = (i + 1) % 6;
        mesh.triangles.push_back({i, next, next + 6});
        mesh.triangles.push_back({i, next + 6, i + 6});
    }
    for (const Triangle& t : {Triangle{0, 3, 1}, {1, 3, 2}, {0, 5, 3}, {3, 5, 4}}) {
        mesh.triangles.push_back({t[0], t[2], t[1]});
        mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
    }
    for (Triangle& t : mesh.triangles) {
        std::swap(t[1], t[2]);
    }
    return mesh;
}

inline std::shared_ptr<const Solid> primitive_solid(Primitive::Kind kind, const Vec3& size, double radius,
                                                    double length, const Pose& pose = {}) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, Primitive{kind, size, radius, length}, pose}});
}

/// Makers of solids by name.
inline const std::map<std::string, std::function<std::shared_ptr<const Solid>()>>& solids() {
    using Kind = Primitive::Kind;
    static const std::map<std::string, std::function<std::shared_ptr<const Solid>()>> makers{
        {"Box",
         [] {
             return Solid::make(box_mesh({0.1, 0.2, 0.3}));
         }},
        {"BoxPrimitive",
         [] {
             return primitive_solid(Kind::box, {0.1, 0.2, 0.3}, 0, 0);
         }},
        {"BallPrimitive", [] { return primitive_solid(Kind::sphere, {}, 0.1, 0); }},
        {"CylinderPrimitive",
         [] {
             return primitive_solid(Kind::cylinder, {}, 0.05, 0.3, Pose::from_xyz_rpy({0.1, 0, 0}, {0.3, 0.2, 0.1}));
         }},
        {"CapsulePrimitive", [] { return primitive_solid(Kind::capsule, {}, 0.05, 0.3); }},
        {"Torus", [] { return Solid::make(torus_mesh(0.1, 0.03)); }},
        {"Bracket", [] { return Solid::make(bracket_mesh()); }},
        {"MirroredBracket",
         [] {
             return Solid::make(transformed(bracket_mesh(), Pose{}, {-1, 1, 1}));
         }},
        {"ThinPlate",
         [] {
             return Solid::make(box_mesh({0.3, 0.2, 0.001}));
         }},
        {"FlatSquare",
         [] {
             return Solid::make(Mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
         }},
        {"SingleTriangle",
         [] {
             return Solid::make(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}}, {{0, 1, 2}}});
         }},
        {"TwoBoxes",
         [] {
             Mesh mesh = box_mesh({0.1, 0.1, 0.1});
             append(mesh, box_mesh({0.1, 0.05, 0.2}, {0.5, 0, 0}));
             return Solid::make(mesh);
         }},
        {"OverlappingParts",
         [] {
             return Solid::make(std::vector<Solid::Part>{
                 {std::make_shared<const Mesh>(box_mesh({0.1, 0.1, 0.1})), {}, {}},
                 {nullptr, Primitive{Kind::cylinder, {}, 0.03, 0.3}, Pose::from_xyz_rpy({0.02, 0, 0}, {0, 1, 0})}});
         }},
        {"OpenCup",
         [] {
             Mesh mesh = box_mesh({0.1, 0.1, 0.1});
             mesh.triangles.resize(10);
             return Solid::make(mesh);
         }},
        {"Tiny",
         [] {
             return Solid::make(box_mesh({1e-7, 2e-7, 1e-7}));
         }},
        {"Huge",
         [] {
             return Solid::make(box_mesh({1e4, 2e4, 1e4}));
         }},
        {"FarAway",
         [] {
             return Solid::make(box_mesh({0.1, 0.1, 0.2}, {5e3, -2e3, 1e3}));
         }},
        {"Needle",
         [] {
             return Solid::make(box_mesh({0.003, 0.003, 1}));
         }},
    };
    return makers;
}

} // namespace foam::test
