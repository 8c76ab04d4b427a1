#include <foam/mesh.hpp>

#include <fmt/format.h>

#include <numeric>

namespace foam {
namespace {

/// A triangle's side as seen from it.
struct HalfEdge {
    std::uint32_t low, high, triangle;
    bool forward; // from low to high
};

/// Disjoint sets with path halving.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) {
            i = parent_[i] = parent_[parent_[i]];
        }
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }
    std::size_t count() {
        std::size_t roots = 0;
        for (std::uint32_t i = 0; i < parent_.size(); ++i) {
            roots += parent_[i] == i;
        }
        return roots;
    }

private:
    std::vector<std::uint32_t> parent_;
};

bool degenerate(const Mesh& mesh, const Triangle& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        return true;
    }
    const Vec3& p = mesh.vertices[t[0]];
    return cross(mesh.vertices[t[1]] - p, mesh.vertices[t[2]] - p) == Vec3{};
}

std::vector<HalfEdge> sorted_half_edges(const Mesh& mesh) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle& t = mesh.triangles[i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            if (from != to) {
                edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
            }
        }
    }
    std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
        return std::tie(a.low, a.high, a.triangle, a.forward) < std::tie(b.low, b.high, b.triangle, b.forward);
    });
    return edges;
}

/// A corner's number: 3 · triangle + its place. The corners at a vertex form one fan exactly if they are connected over
/// the edges they share.
std::uint32_t corner_at(const Mesh& mesh, std::uint32_t triangle, std::uint32_t vertex) {
    const Triangle& t = mesh.triangles[triangle];
    return 3 * triangle + (t[0] == vertex ? 0u : t[1] == vertex ? 1u : 2u);
}

} // namespace

Topology topology(const Mesh& mesh) {
    Topology result;
    Sets parts(mesh.triangles.size());
    Sets fans(3 * mesh.triangles.size());
    const std::vector<HalfEdge> edges = sorted_half_edges(mesh);
    for (std::size_t begin = 0; begin < edges.size();) {
        std::size_t end = begin;
        std::size_t forward = 0;
        while (end < edges.size() && edges[end].low == edges[begin].low && edges[end].high == edges[begin].high) {
            forward += edges[end].forward;
            parts.unite(edges[begin].triangle, edges[end].triangle);
            for (const std::uint32_t vertex : {edges[begin].low, edges[begin].high}) {
                fans.unite(corner_at(mesh, edges[begin].triangle, vertex),
                           corner_at(mesh, edges[end].triangle, vertex));
            }
            ++end;
        }
        const std::size_t count = end - begin;
        result.boundary_edges += count == 1;
        result.nonmanifold_edges += count > 2;
        result.misoriented_edges += count == 2 && forward != 1;
        begin = end;
    }
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

} // namespace foam
