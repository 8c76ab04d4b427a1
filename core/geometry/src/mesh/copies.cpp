#include "mesh/copies.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/welding.hpp>

#include <algorithm>
#include <array>
#include <unordered_set>

namespace foam::inline geometry {
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
