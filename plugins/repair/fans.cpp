#include "soup.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh_checks.hpp>

#include <algorithm>

namespace foam::repair {
namespace {

std::uint32_t start_of(const Mesh& mesh, std::uint32_t side) {
    return mesh.triangles[side / 3][side % 3];
}

/// Reverses triangle i. Swaps sides 0 and 2 (0→1, 1→2, 2→0 becomes 0→2, 2→1, 1→0); side 1 stays the same edge.
void reverse(Mesh& mesh, Neighbours& neighbours, std::uint32_t i) {
    std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
    const std::uint32_t first = neighbours[3 * i], last = neighbours[3 * i + 2];
    std::swap(neighbours[3 * i], neighbours[3 * i + 2]);
    neighbours[first] = 3 * i + 2;
    neighbours[last] = 3 * i;
}

/// Sorts the sides of one edge by angle around it, so that the first two, the next two, … have the inside between them.
/// With the edge's direction from the lower to the higher vertex, the inside follows (counter-clockwise) after a
/// triangle with the edge backwards, and ends at one with the edge forwards. Returns false if they do not alternate.
bool sort_inside_between(const Mesh& mesh, std::vector<std::uint32_t>& sides) {
    const auto start = [&](std::uint32_t side) { return mesh.triangles[side / 3][side % 3]; };
    const auto end = [&](std::uint32_t side) { return mesh.triangles[side / 3][(side % 3 + 1) % 3]; };
    const auto tip = [&](std::uint32_t side) { return mesh.vertices[mesh.triangles[side / 3][(side % 3 + 2) % 3]]; };
    const std::uint32_t low = std::min(start(sides[0]), end(sides[0])), high = std::max(start(sides[0]), end(sides[0]));
    const Vec3 origin = mesh.vertices[low], axis = normalized(mesh.vertices[high] - origin);
    const Vec3 first = tip(sides[0]) - origin, u = normalized(first - axis * dot(first, axis)), v = cross(axis, u);
    std::vector<std::pair<double, std::uint32_t>> by_angle;
    for (const std::uint32_t side : sides) {
        const Vec3 arm = tip(side) - origin;
        by_angle.emplace_back(std::atan2(dot(arm, v), dot(arm, u)), side);
    }
    std::sort(by_angle.begin(), by_angle.end());
    const auto backward = [&](std::size_t i) { return start(by_angle[i % by_angle.size()].second) == high; };
    const std::size_t offset = backward(0) ? 0 : 1;
    for (std::size_t i = 0; i < by_angle.size(); ++i) {
        if (backward(offset + i) != (i % 2 == 0) ||
            (i > 0 && by_angle[i].first == by_angle[i - 1].first)) { // coincident triangles have no order
            return false;
        }
        sides[i] = by_angle[(offset + i) % by_angle.size()].second;
    }
    return true;
}

} // namespace

std::optional<Neighbours> neighbours(const Mesh& mesh) {
    const std::vector<Side> sides = sides_by_edge(mesh.triangles, mesh.vertices.size());
    if (sides.size() != 3 * mesh.triangles.size()) {
        return std::nullopt; // a triangle has a vertex twice
    }
    Neighbours result(sides.size(), no_index);
    bool sound = true;
    std::vector<std::uint32_t> around;
    for_each_edge(sides, [&](std::span<const Side> edge) {
        sound = sound && edge.size() % 2 == 0;
        if (!sound) {
            return;
        }
        around.clear();
        for (const Side& side : edge) {
            around.push_back(side.number);
        }
        sound = around.size() == 2 || sort_inside_between(mesh, around);
        for (std::size_t i = 0; i < around.size(); i += 2) {
            result[around[i]] = around[i + 1];
            result[around[i + 1]] = around[i];
        }
    });
    return sound ? std::optional(std::move(result)) : std::nullopt;
}

Components components(const Mesh& mesh, const Neighbours& neighbours) {
    Components result;
    result.of_triangle.assign(mesh.triangles.size(), no_index);
    std::vector<std::uint32_t> open;
    CancellationCounter asking(4096);
    for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        asking.check();
        if (result.of_triangle[seed] != no_index) {
            continue;
        }
        const auto number = static_cast<std::uint32_t>(result.count++);
        result.of_triangle[seed] = number;
        open.push_back(seed);
        while (!open.empty()) {
            const std::uint32_t i = open.back();
            open.pop_back();
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t j = neighbours[3 * i + k] / 3;
                if (result.of_triangle[j] == no_index) {
                    result.of_triangle[j] = number;
                    open.push_back(j);
                }
            }
        }
    }
    return result;
}

bool orient(Mesh& mesh, Neighbours& neighbours, const Components& components, std::vector<char>& mixed) {
    mixed.assign(components.count, 0);
    std::vector<char> seen(mesh.triangles.size(), 0);
    std::vector<std::uint32_t> open;
    CancellationCounter asking(4096);
    for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        asking.check();
        if (seen[seed]) {
            continue;
        }
        seen[seed] = 1;
        open.push_back(seed);
        while (!open.empty()) {
            const std::uint32_t i = open.back();
            open.pop_back();
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t side = neighbours[3 * i + k];
                const bool agrees = start_of(mesh, side) != mesh.triangles[i][k];
                if (seen[side / 3]) {
                    if (!agrees) {
                        return false;
                    }
                    continue;
                }
                if (!agrees) {
                    mixed[components.of_triangle[i]] = 1;
                    reverse(mesh, neighbours, side / 3);
                }
                seen[side / 3] = 1;
                open.push_back(side / 3);
            }
        }
    }
    return true;
}

std::size_t split_fans(Mesh& mesh, const Neighbours& neighbours) {
    const std::size_t before = mesh.vertices.size();
    std::vector<char> corner_done(3 * mesh.triangles.size(), 0);
    std::vector<char> vertex_used(before, 0);
    CancellationCounter asking(4096);
    for (std::uint32_t first = 0; first < corner_done.size(); ++first) {
        asking.check();
        if (corner_done[first]) {
            continue;
        }
        std::uint32_t vertex = start_of(mesh, first);
        if (vertex_used[vertex]) {
            mesh.vertices.push_back(Vec3(mesh.vertices[vertex]));
            vertex = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
        } else {
            vertex_used[vertex] = 1;
        }
        // Around the vertex: over the outgoing side, to the corner after that side in the next triangle.
        for (std::uint32_t corner = first; !corner_done[corner];) {
            corner_done[corner] = 1;
            mesh.triangles[corner / 3][corner % 3] = vertex;
            const std::uint32_t side = neighbours[corner];
            corner = side / 3 * 3 + (side % 3 + 1) % 3;
        }
    }
    return mesh.vertices.size() - before;
}

} // namespace foam::repair
