#include "weld.hpp"

#include <array>
#include <map>

namespace foam::repair {
namespace {

using Key = std::array<double, 3>;

Key key_of(const Vec3& p, double cell) {
    return {std::floor(p.x / cell), std::floor(p.y / cell), std::floor(p.z / cell)};
}

} // namespace

Mesh welded_within(const Mesh& mesh, double tolerance) {
    // A grid whose cells are as long as the tolerance: partners are in the same cell or one beside it.
    std::map<Key, std::vector<std::uint32_t>> kept;
    std::vector<std::uint32_t> stands_for(mesh.vertices.size());
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& p = mesh.vertices[i];
        const Key key = key_of(p, tolerance);
        stands_for[i] = i;
        for (int step = 0; step < 27 && stands_for[i] == i; ++step) {
            const auto found = kept.find({key[0] + step % 3 - 1, key[1] + step / 3 % 3 - 1, key[2] + step / 9 - 1});
            if (found == kept.end()) {
                continue;
            }
            for (const std::uint32_t other : found->second) {
                if (distance(mesh.vertices[other], p) <= tolerance) {
                    stands_for[i] = other;
                    break;
                }
            }
        }
        if (stands_for[i] == i) {
            kept[key].push_back(i);
        }
    }
    Mesh result{mesh.vertices, {}};
    for (const auto& [a, b, c] : mesh.triangles) {
        result.triangles.push_back({stands_for[a], stands_for[b], stands_for[c]});
    }
    return welded(result);
}

} // namespace foam::repair
