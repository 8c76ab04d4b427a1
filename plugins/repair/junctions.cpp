#include "soup.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <algorithm>

namespace foam::repair {
namespace {

/// Returns the vertices of open sides, ordered by x.
std::vector<std::uint32_t> vertices_by_x(const Mesh& mesh, const std::vector<OpenSide>& sides) {
    std::vector<std::uint32_t> vertices;
    CancellationCounter asking(1024);
    for (const OpenSide& side : sides) {
        asking.check();
        vertices.push_back(side.from);
        vertices.push_back(side.to);
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::stable_sort(vertices.begin(), vertices.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return mesh.vertices[a].x < mesh.vertices[b].x; });
    return vertices;
}

/// Returns the vertices on the side, from its start to its end.
std::vector<std::uint32_t> vertices_on(const Mesh& mesh, const OpenSide& side, const std::vector<std::uint32_t>& by_x,
                                       double tolerance) {
    const Vec3 &a = mesh.vertices[side.from], &b = mesh.vertices[side.to];
    const Vec3 along = b - a;
    const double length2 = squared_norm(along);
    const double low = std::min(a.x, b.x) - tolerance, high = std::max(a.x, b.x) + tolerance;
    auto next = std::lower_bound(by_x.begin(), by_x.end(), low,
                                 [&](std::uint32_t v, double x) { return mesh.vertices[v].x < x; });
    std::vector<std::pair<double, std::uint32_t>> found;
    for (; next != by_x.end() && mesh.vertices[*next].x <= high; ++next) {
        const Vec3& p = mesh.vertices[*next];
        const double t = dot(p - a, along) / length2;
        const bool between = distance(p, a) > tolerance && distance(p, b) > tolerance && t > 0 && t < 1;
        if (between && distance(p, a + along * t) <= tolerance) {
            found.emplace_back(t, *next);
        }
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> result;
    for (const auto& [t, vertex] : found) {
        result.push_back(vertex);
    }
    return result;
}

/// Runs one pass, which splits at most one side of each triangle.
std::size_t split_once(Mesh& mesh, double tolerance) {
    const std::vector<OpenSide> sides = open_sides(mesh);
    const std::vector<std::uint32_t> by_x = vertices_by_x(mesh, sides);
    std::size_t splits = 0;
    std::uint32_t last = 0xFFFFFFFFu;
    CancellationCounter asking(1024);
    for (const OpenSide& side : sides) {
        asking.check();
        if (side.triangle == last) {
            continue;
        }
        const std::vector<std::uint32_t> on = vertices_on(mesh, side, by_x, tolerance);
        const Triangle t = mesh.triangles[side.triangle];
        const std::uint32_t tip = t[(side.place + 2) % 3];
        if (on.empty() || std::find(on.begin(), on.end(), tip) != on.end()) {
            continue;
        }
        last = side.triangle;
        splits += on.size();
        mesh.triangles[side.triangle] = {side.from, on.front(), tip};
        for (std::size_t i = 0; i < on.size(); ++i) {
            mesh.triangles.push_back({on[i], i + 1 < on.size() ? on[i + 1] : side.to, tip});
        }
    }
    return splits;
}

} // namespace

std::size_t join_t_junctions(Mesh& mesh, double tolerance) {
    std::size_t splits = 0;
    for (int pass = 0; pass < 3; ++pass) { // a triangle has three sides
        check_cancelled();
        const std::size_t now = split_once(mesh, tolerance);
        splits += now;
        if (now == 0) {
            break;
        }
    }
    return splits;
}

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
