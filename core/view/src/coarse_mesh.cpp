#include "drawn_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace foam::inline view {
namespace {

constexpr double most_cells = 2'097'151; ///< along an axis: 21 bits of a key

/// The clusters of the vertices of a mesh.
struct Clusters {
    std::vector<std::uint32_t> of_vertex;
    std::vector<Vec3> means;

    Clusters(const Mesh& mesh, double cell) {
        const Box box = bounds(mesh);
        std::unordered_map<std::uint64_t, std::uint32_t> index;
        std::vector<std::size_t> counts;
        of_vertex.reserve(mesh.vertices.size());
        for (const Vec3& vertex : mesh.vertices) {
            std::uint64_t key = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double at = std::clamp(std::floor((vertex[axis] - box.low[axis]) / cell), 0.0, most_cells);
                key = key << 21 | static_cast<std::uint64_t>(at);
            }
            const auto [entry, fresh] = index.try_emplace(key, static_cast<std::uint32_t>(means.size()));
            if (fresh) {
                means.emplace_back();
                counts.push_back(0);
            }
            means[entry->second] += vertex;
            ++counts[entry->second];
            of_vertex.push_back(entry->second);
        }
        for (std::size_t c = 0; c < means.size(); ++c) {
            means[c] = means[c] / static_cast<double>(counts[c]);
        }
    }
};

} // namespace

ViewedMesh coarsened(const ViewedMesh& mesh, double cell) {
    Clusters clusters(*mesh.mesh, cell);
    Mesh coarse;
    ViewedMesh result;
    for (std::size_t t = 0; t < mesh.mesh->triangles.size(); ++t) {
        const Triangle& triangle = mesh.mesh->triangles[t];
        const Triangle merged{clusters.of_vertex[triangle[0]], clusters.of_vertex[triangle[1]],
                              clusters.of_vertex[triangle[2]]};
        if (merged[0] != merged[1] && merged[1] != merged[2] && merged[2] != merged[0]) {
            coarse.triangles.push_back(merged);
            if (!mesh.colours.empty()) {
                result.colours.push_back(mesh.colours[t]);
            }
        }
    }
    coarse.vertices = std::move(clusters.means);
    result.mesh = std::make_shared<const Mesh>(std::move(coarse));
    return result;
}

double cell_for(double area, std::size_t triangles) {
    return triangles > 0 ? std::sqrt(3 * area / static_cast<double>(triangles)) : 0; // a cell has about 3 triangles
}

} // namespace foam::inline view
