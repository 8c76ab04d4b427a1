#include "unit_sphere.hpp"

#include <bit>
#include <cstdint>
#include <map>
#include <utility>

namespace foam::gltf {
namespace {

Mesh icosahedron() {
    const double t = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    mesh.vertices = {{-1, t, 0},  {1, t, 0},  {-1, -t, 0}, {1, -t, 0}, {0, -1, t},  {0, 1, t},
                     {0, -1, -t}, {0, 1, -t}, {t, 0, -1},  {t, 0, 1},  {-t, 0, -1}, {-t, 0, 1}};
    mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (Vec3& p : mesh.vertices) {
        p = normalized(p);
    }
    return mesh;
}

/// Returns the mesh with each triangle split into four.
Mesh split(const Mesh& mesh) {
    Mesh result;
    result.vertices = mesh.vertices;
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

void add_bytes(std::string& bytes, std::uint32_t number, int count) {
    for (int i = 0; i < count; ++i) {
        bytes += static_cast<char>(number >> (8 * i) & 0xFFU);
    }
}

} // namespace

Mesh unit_sphere(int subdivisions) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < subdivisions; ++i) {
        mesh = split(mesh);
    }
    return mesh;
}

std::string corner_bytes(const Mesh& mesh) {
    std::string bytes;
    for (const Vec3& p : mesh.vertices) {
        for (const double x : {p.x, p.y, p.z}) {
            add_bytes(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(x)), 4);
        }
    }
    return bytes;
}

std::string index_bytes(const Mesh& mesh) {
    std::string bytes;
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            add_bytes(bytes, corner, 4);
        }
    }
    return bytes;
}

std::string buffer_of(const Mesh& mesh) {
    std::string bytes = corner_bytes(mesh);
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            add_bytes(bytes, corner, 2);
        }
    }
    return bytes;
}

} // namespace foam::gltf
