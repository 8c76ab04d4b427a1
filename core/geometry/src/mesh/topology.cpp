#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <fmt/format.h>

namespace foam::inline geometry {
namespace {

bool degenerate(const Mesh& mesh, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        return true;
    }
    const Vec3& p = mesh.vertices[t[0]];
    return cross(mesh.vertices[t[1]] - p, mesh.vertices[t[2]] - p) == Vec3{};
}

/// Returns a corner's number: 3 · triangle + its index. The corners at a vertex form one fan exactly if they are
/// connected over their common edges.
std::uint32_t corner_at(const Mesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
    const Triangle& t = mesh.triangles[triangle];
    return 3 * triangle + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
}

} // namespace

Topology topology(const Mesh& mesh) {
    Topology result;
    geometry::DisjointSets parts(mesh.triangles.size());
    geometry::DisjointSets fans(3 * mesh.triangles.size());
    for_each_edge(sides_by_edge(mesh.triangles, mesh.vertices.size()), [&](std::span<const Side> sides) {
        const Side& first = sides.front();
        std::size_t forward = first.forward;
        for (const Side& side : sides.subspan(1)) {
            forward += side.forward;
            parts.unite(first.triangle(), side.triangle());
            for (const std::uint32_t vertex : {first.low, first.high}) {
                fans.unite(corner_at(mesh, first.triangle(), vertex), corner_at(mesh, side.triangle(), vertex));
            }
        }
        result.boundary_edges += sides.size() == 1;
        result.nonmanifold_edges += sides.size() > 2;
        result.misoriented_edges += sides.size() == 2 && forward != 1;
    });
    std::vector<std::uint32_t> fan_of(mesh.vertices.size(), 0xFFFFFFFFu);
    std::vector<char> split(mesh.vertices.size(), 0);
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        result.degenerate_triangles += degenerate(mesh, mesh.triangles[i]);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[i][k];
            const std::uint32_t fan = fans.find(3 * i + k);
            if (fan_of[vertex] == 0xFFFFFFFFu) {
                fan_of[vertex] = fan;
            } else if (fan_of[vertex] != fan) {
                split[vertex] = 1;
            }
        }
    }
    result.nonmanifold_vertices = static_cast<std::size_t>(std::count(split.begin(), split.end(), 1));
    result.components = parts.count();
    return result;
}

std::string describe(const Topology& topology) {
    std::string text;
    const auto mention = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) {
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, count == 1 ? one : many);
        }
    };
    mention(topology.boundary_edges, "boundary edge", "boundary edges");
    mention(topology.nonmanifold_edges, "non-manifold edge", "non-manifold edges");
    mention(topology.nonmanifold_vertices, "non-manifold vertex", "non-manifold vertices");
    mention(topology.misoriented_edges, "misoriented edge", "misoriented edges");
    mention(topology.degenerate_triangles, "degenerate triangle", "degenerate triangles");
    if (topology.components != 1) {
        mention(topology.components, "component", "components");
    }
    return text.empty() ? "closed 2-manifold" : text;
}

} // namespace foam::geometry
