#include "geometry/welding.hpp"

#include <bit>
#include <numeric>

namespace foam::geometry {
namespace {

std::uint64_t hash_of(const Vec3& v) {
    std::uint64_t hash = 0;
    for (const double value : {v.x, v.y, v.z}) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9E3779B97F4A7C15u; // -0 becomes 0
        hash ^= hash >> 32;
    }
    return hash;
}

} // namespace

std::vector<std::uint32_t> welded_indices(const Mesh& mesh) {
    constexpr std::uint32_t free = 0xFFFFFFFFu;
    const std::size_t mask = std::bit_ceil(2 * mesh.vertices.size() + 1) - 1;
    std::vector<std::uint32_t> table(mask + 1, free); // open addressing, at most half full
    std::vector<std::uint32_t> result(mesh.vertices.size());
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        std::size_t slot = hash_of(mesh.vertices[i]) & mask;
        while (table[slot] != free && mesh.vertices[table[slot]] != mesh.vertices[i]) {
            slot = (slot + 1) & mask;
        }
        if (table[slot] == free) {
            table[slot] = i;
        }
        result[i] = table[slot];
    }
    return result;
}

std::vector<Side> sides_by_edge(const std::vector<Triangle>& triangles, const std::vector<char>& use,
                                std::size_t vertex_count) {
    std::vector<std::uint32_t> start(vertex_count + 1, 0);
    const auto for_each_side = [&](auto visit) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t k = 0; use[i] && k < 3; ++k) {
                const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
                if (from != to) {
                    visit(Side{std::min(from, to), std::max(from, to), i, from < to});
                }
            }
        }
    };
    for_each_side([&](const Side& side) { ++start[side.low + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Side> sides(start.back());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for_each_side([&](const Side& side) { sides[next[side.low]++] = side; });
    for (std::size_t v = 0; v < vertex_count; ++v) {
        std::sort(sides.begin() + start[v], sides.begin() + start[v + 1], [](const Side& a, const Side& b) {
            return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
        });
    }
    return sides;
}

DisjointSets::DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
}

std::uint32_t DisjointSets::find(std::uint32_t i) {
    while (parent_[i] != i) {
        i = parent_[i] = parent_[parent_[i]];
    }
    return i;
}

void DisjointSets::unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

} // namespace foam::geometry
