#include <foam/geometry/internal/cavities.hpp>

#include <foam/geometry/internal/welding.hpp>

namespace foam::inline geometry {
namespace {

/// A connected component of the surface.
struct Shell {
    double volume = 0, area = 0;
    Vec3 facing; ///< ∫ n: zero for a closed shell

    bool nearly_closed() const {
        constexpr double holes = 0.01; // of the area
        return norm(facing) <= holes * area;
    }
};

} // namespace

double cavity_volume(const Solid& solid) {
    if (solid.parts().size() != 1 || solid.parts().front().primitive) {
        return 0;
    }
    const Mesh& mesh = solid.surface(); // wound outwards, but for the shells of cavities
    const std::vector<std::uint32_t> corner = welded_indices(mesh);
    DisjointSets sets(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        sets.unite(corner[a], corner[b]);
        sets.unite(corner[a], corner[c]);
    }
    const Vec3 center = solid.bounds().center();
    std::vector<Shell> shells(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        Shell& shell = shells[sets.find(corner[a])];
        const Vec3 p = mesh.vertices[a] - center, q = mesh.vertices[b] - center, r = mesh.vertices[c] - center;
        const Vec3 normal = cross(q - p, r - p) * 0.5;
        shell.volume += dot(p, normal) / 3;
        shell.facing += normal;
        shell.area += norm(normal);
    }
    double bodies = 0, cavities = 0;
    for (const Shell& shell : shells) {
        (shell.volume < 0 ? cavities : bodies) += shell.nearly_closed() ? std::abs(shell.volume) : 0;
    }
    constexpr double rounding = 1e-6; // all that remains of a sheet, which has no inside
    return cavities > rounding * bodies ? std::min(cavities, bodies) : 0;
}

} // namespace foam::geometry
