#include "octree.hpp"

#include <foam/geometry/mesh_checks.hpp>

#include <algorithm>

namespace foam::repair {
namespace {

constexpr int halvings = 4;

/// Returns the vertices of the triangles, and if `wide` of all triangles that share a vertex with them.
std::vector<char> vertices_of(const Mesh& mesh, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                              bool wide) {
    std::vector<char> touched(mesh.vertices.size(), 0);
    for (const auto& [a, b] : pairs) {
        for (const std::uint32_t i : {a, b}) {
            for (const std::uint32_t v : mesh.triangles[i]) {
                touched[v] = 1;
            }
        }
    }
    if (wide) {
        const std::vector<char> inner = touched;
        for (const Triangle& t : mesh.triangles) {
            if (inner[t[0]] || inner[t[1]] || inner[t[2]]) {
                touched[t[0]] = touched[t[1]] = touched[t[2]] = 1;
            }
        }
    }
    return touched;
}

} // namespace

std::size_t untangle(Mesh& mesh, const Mesh& voxels, Context& context) {
    std::vector<int> times(mesh.vertices.size(), 0); // how often a vertex went back
    for (int round = 0;; ++round) {
        context.check_cancelled();
        const auto pairs = self_intersections(mesh);
        if (pairs.empty()) {
            break;
        }
        // The first rounds move as little as possible. Later ones include the neighbours, so that the loop ends.
        const std::vector<char> touched = vertices_of(mesh, pairs, round >= 2 * halvings);
        for (std::size_t i = 0; i < touched.size(); ++i) {
            if (touched[i]) {
                ++times[i];
                mesh.vertices[i] =
                    times[i] >= halvings ? voxels.vertices[i] : (mesh.vertices[i] + voxels.vertices[i]) * 0.5;
            }
        }
        const bool all_back = std::all_of(times.begin(), times.end(), [](int n) { return n >= halvings; });
        if (all_back) {
            break;
        }
    }
    return static_cast<std::size_t>(std::count_if(times.begin(), times.end(), [](int n) { return n > 0; }));
}

} // namespace foam::repair
