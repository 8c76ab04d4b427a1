#include <foam/geometry/internal/triangles.hpp>

#include "mesh/copies.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <unordered_set>

namespace foam::inline geometry {
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
    CancellationCounter asking(1 << 16);
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        asking.check();
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

std::size_t DisjointSets::count() const {
    std::size_t roots = 0;
    for (std::uint32_t i = 0; i < parent_.size(); ++i) {
        roots += parent_[i] == i;
    }
    return roots;
}

namespace {

struct HashOfCorners {
    std::size_t operator()(const Triangle& t) const {
        std::uint64_t hash = 0;
        for (const std::uint32_t corner : t) {
            hash = (hash ^ corner) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 32;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// Returns whether there are more triangles than a surface has for its corners. A closed surface has two for each; one
/// with more corners than triangles repeats them.
bool may_have_copies(const Mesh& mesh) {
    constexpr std::size_t few = 1000, most_a_corner = 4;
    return mesh.triangles.size() > few && (mesh.triangles.size() > most_a_corner * mesh.vertices.size() ||
                                           mesh.vertices.size() > mesh.triangles.size());
}

/// Returns the mesh with each triangle once: of those with the same corners in the same sense, the first.
Mesh each_once(const Mesh& mesh) {
    const std::vector<std::uint32_t> place = welded_indices(mesh);
    std::unordered_set<Triangle, HashOfCorners> known;
    Mesh result{mesh.vertices, {}};
    CancellationCounter asking(8192);
    for (const Triangle& t : mesh.triangles) {
        asking.check();
        Triangle corners{place[t[0]], place[t[1]], place[t[2]]};
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        if (known.insert(corners).second) {
            result.triangles.push_back(t);
        }
    }
    return result;
}

} // namespace

std::optional<Mesh> without_copies(const Mesh& mesh) {
    if (!may_have_copies(mesh)) {
        return std::nullopt;
    }
    Mesh once = each_once(mesh);
    return 2 * once.triangles.size() <= mesh.triangles.size() ? std::optional(std::move(once)) : std::nullopt;
}

} // namespace foam::inline geometry
