#include "convex/kind.hpp"

#include <foam/geometry/inscribed_mesh.hpp>

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace foam::inline geometry {
namespace {

Mesh icosahedron() {
    constexpr double g = std::numbers::phi;
    Mesh mesh;
    mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& p : mesh.vertices) {
        p = normalized(p);
    }
    return mesh;
}

/// Returns the mesh with each triangle split into four.
Mesh split_in_four(const Mesh& mesh) {
    Mesh result{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [it, is_new] = middles.emplace(std::minmax(a, b), result.vertices.size());
        if (is_new) {
            result.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
        }
        return it->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        result.triangles.insert(result.triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    return result;
}

} // namespace

Mesh inscribed_mesh(const Element& element, int segments) {
    Mesh mesh = enclosing_mesh(element, segments);
    if (kind_of(element).has_flat_faces()) {
        return mesh;
    }
    const Vec3 middle = element.pose.translation;
    for (Vec3& p : mesh.vertices) { // along the ray from the middle, to where it leaves the element
        const std::optional<LinePart> within = inside_along(element, middle, p - middle);
        p = middle + (p - middle) * (within ? std::clamp(within->leave, 0.0, 1.0) : 0.0);
    }
    return mesh;
}

Mesh icosphere(int subdivisions) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < subdivisions; ++i) {
        mesh = split_in_four(mesh);
    }
    return mesh;
}

} // namespace foam::inline geometry
