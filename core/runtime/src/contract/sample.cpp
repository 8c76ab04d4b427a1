#include <foam/runtime/contract.hpp>

#include <numbers>

namespace foam::inline runtime::sample {
namespace {

std::shared_ptr<const Solid> primitive_solid(const Element& primitive, const Pose& pose = {}) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, primitive, pose}});
}

} // namespace

Mesh box(const Vec3& size, const Vec3& center) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.vertices.push_back(
            center + Vec3{(i & 1 ? 0.5 : -0.5) * size.x, (i & 2 ? 0.5 : -0.5) * size.y, (i & 4 ? 0.5 : -0.5) * size.z});
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

Mesh torus(double large, double small, std::uint32_t around, std::uint32_t across) {
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

// An outline in the xz plane, extruded along y.
Mesh bracket() {
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
        mesh.triangles.push_back({i, next + 6, next});
        mesh.triangles.push_back({i, i + 6, next + 6});
    }
    for (const auto& [a, b, c] : {Triangle{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}}) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a + 6, c + 6, b + 6});
    }
    return mesh;
}

using Makers = std::map<std::string, std::function<std::shared_ptr<const Solid>()>>;

/// Solids that are one primitive each.
static Makers of_primitives() {
    return {
        {"BoxPrimitive",
         [] {
             return primitive_solid(Element::box({0.1, 0.2, 0.3}));
         }},
        {"BallPrimitive", [] { return primitive_solid(Element::sphere(0.1)); }},
        {"CylinderPrimitive",
         [] {
             return primitive_solid(Element::cylinder(0.05, 0.3), Pose::from_xyz_rpy({0.1, 0, 0}, {0.3, 0.2, 0.1}));
         }},
        {"CapsulePrimitive", [] { return primitive_solid(Element::capsule(0.05, 0.3)); }},
        {"EllipsoidPrimitive",
         [] {
             return primitive_solid(Element::ellipsoid({0.05, 0.1, 0.15}), Pose::from_xyz_rpy({0, 0.1, 0}, {0.3, 0.2, 0.1}));
         }},
    };
}

/// Solids of meshes, and of several parts.
static Makers of_meshes() {
    return {
        {"Box",
         [] {
             return Solid::make(box({0.1, 0.2, 0.3}));
         }},
        {"Torus", [] { return Solid::make(torus(0.1, 0.03)); }},
        {"Bracket", [] { return Solid::make(bracket()); }},
        {"MirroredBracket",
         [] {
             return Solid::make(transformed(bracket(), Pose{}, {-1, 1, 1}));
         }},
        {"ThinPlate",
         [] {
             return Solid::make(box({0.3, 0.2, 0.001}));
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
             Mesh mesh = box({0.1, 0.1, 0.1});
             append(mesh, box({0.1, 0.05, 0.2}, {0.5, 0, 0}));
             return Solid::make(mesh);
         }},
        {"OverlappingParts",
         [] {
             return Solid::make(std::vector<Solid::Part>{
                 {std::make_shared<const Mesh>(box({0.1, 0.1, 0.1})), {}, {}},
                 {nullptr, Element::cylinder(0.03, 0.3), Pose::from_xyz_rpy({0.02, 0, 0}, {0, 1, 0})}});
         }},
        {"OpenCup",
         [] {
             Mesh mesh = box({0.1, 0.1, 0.1});
             mesh.triangles.resize(10);
             return Solid::make(mesh);
         }},
        {"Tiny",
         [] {
             return Solid::make(box({1e-7, 2e-7, 1e-7}));
         }},
        {"Huge",
         [] {
             return Solid::make(box({1e4, 2e4, 1e4}));
         }},
        {"FarAway",
         [] {
             return Solid::make(box({0.1, 0.1, 0.2}, {5e3, -2e3, 1e3}));
         }},
        {"Needle",
         [] {
             return Solid::make(box({0.003, 0.003, 1}));
         }},
    };
}

const std::map<std::string, std::function<std::shared_ptr<const Solid>()>>& solids() {
    static const Makers makers = [] {
        Makers all = of_primitives();
        all.merge(of_meshes());
        return all;
    }();
    return makers;
}

} // namespace foam::runtime::sample
