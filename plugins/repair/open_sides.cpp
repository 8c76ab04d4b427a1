#include "open_sides.hpp"

#include <foam/geometry/mesh_checks.hpp>

#include <algorithm>

namespace foam::repair {

std::vector<OpenSide> open_sides(const Mesh& mesh) {
    std::vector<std::uint32_t> alone;
    for_each_edge(sides_by_edge(mesh.triangles, mesh.vertices.size()), [&](std::span<const Side> edge) {
        if (edge.size() == 1) {
            alone.push_back(edge[0].number);
        }
    });
    std::sort(alone.begin(), alone.end());
    std::vector<OpenSide> open;
    for (const std::uint32_t side : alone) {
        const Triangle& t = mesh.triangles[side / 3];
        open.push_back({t[side % 3], t[(side % 3 + 1) % 3], side / 3, side % 3});
    }
    return open;
}

} // namespace foam::repair
