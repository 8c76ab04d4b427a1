#include "icosphere.hpp"

#include <map>
#include <numbers>
#include <utility>

namespace foam {
namespace {

Mesh icosahedron() {
    constexpr double g = std::numbers::phi;
    Mesh mesh{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (Vec3& vertex : mesh.vertices) {
        vertex = normalized(vertex);
    }
    return mesh;
}

Mesh subdivided(const Mesh& mesh) {
    Mesh result{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of_edge;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [it, added] =
            middle_of_edge.emplace(std::minmax(a, b), static_cast<std::uint32_t>(result.vertices.size()));
        if (added) {
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

Mesh icosphere(int subdivisions) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < subdivisions; ++i) {
        mesh = subdivided(mesh);
    }
    return mesh;
}

} // namespace foam
