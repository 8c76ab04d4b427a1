#include "facing.hpp"

#include "triangle.hpp"

#include <foam/edges.hpp>
#include <foam/solid.hpp>

#include <algorithm>
#include <numeric>

namespace foam::repair {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFu;

/// For side k of triangle i, at 3 i + k: the triangle over an edge of exactly two; none elsewhere.
std::vector<std::uint32_t> partners(const Mesh& mesh) {
    std::vector<std::uint32_t> result(3 * mesh.triangles.size(), none);
    for_each_edge(sides_by_edge(mesh.triangles, mesh.vertices.size()), [&](std::span<const Side> edge) {
        if (edge.size() == 2) {
            result[edge[0].number] = edge[1].triangle();
            result[edge[1].number] = edge[0].triangle();
        }
    });
    return result;
}

std::vector<std::vector<std::uint32_t>> patches_of(const Mesh& mesh) {
    const std::vector<std::uint32_t> partner = partners(mesh);
    std::vector<char> seen(mesh.triangles.size(), 0);
    std::vector<std::vector<std::uint32_t>> patches;
    for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        if (seen[seed]) {
            continue;
        }
        std::vector<std::uint32_t>& patch = patches.emplace_back(1, seed);
        seen[seed] = 1;
        for (std::size_t next = 0; next < patch.size(); ++next) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t other = partner[3 * patch[next] + k];
                if (other != none && !seen[other]) {
                    seen[other] = 1;
                    patch.push_back(other);
                }
            }
        }
    }
    return patches;
}

enum class Facing { outwards, inwards, wall };

/// By the winding number before and behind the middles of the patch's largest triangles.
Facing facing_of(const Mesh& mesh, const std::vector<std::uint32_t>& patch, const Solid& solid) {
    constexpr std::size_t most_samples = 9;
    std::vector<std::pair<double, std::uint32_t>> by_area; // negated; ties in the order of the patch
    by_area.reserve(patch.size());
    for (std::uint32_t k = 0; k < patch.size(); ++k) {
        by_area.emplace_back(-squared_norm(area_vector(corners(mesh, mesh.triangles[patch[k]]))), k);
    }
    const double step = 1e-6 * solid.bounds().diagonal();
    std::size_t turned = 0, walls = 0;
    const std::size_t samples = std::min(most_samples, patch.size());
    std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(samples), by_area.end());
    for (std::size_t i = 0; i < samples; ++i) {
        const Corners t = corners(mesh, mesh.triangles[patch[by_area[i].second]]);
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3, normal = normalized(area_vector(t));
        const bool before = solid.contains(middle + normal * step), behind = solid.contains(middle - normal * step);
        turned += before && !behind;
        walls += before && behind;
    }
    return 2 * walls > samples ? Facing::wall : 2 * turned > samples ? Facing::inwards : Facing::outwards;
}

} // namespace

FacingReport face_outwards(Mesh& mesh, Context& context) {
    const std::shared_ptr<const Solid> solid = Solid::make(mesh);
    FacingReport report;
    const std::vector<Triangle> given = mesh.triangles;
    mesh.triangles = solid->surface().triangles; // neighbours agree
    std::vector<char> keep(mesh.triangles.size(), 1);
    for (const std::vector<std::uint32_t>& patch : patches_of(mesh)) {
        context.check_cancelled();
        const Facing facing = facing_of(mesh, patch, *solid);
        for (const std::uint32_t i : patch) {
            keep[i] = facing != Facing::wall;
            if (facing == Facing::inwards) {
                std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
            }
        }
    }
    std::vector<Triangle> kept;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (keep[i]) {
            kept.push_back(mesh.triangles[i]);
            const Triangle &now = mesh.triangles[i], &was = given[i];
            const bool same =
                now == was || now == Triangle{was[1], was[2], was[0]} || now == Triangle{was[2], was[0], was[1]};
            report.turned += !same;
        }
    }
    report.walls = mesh.triangles.size() - kept.size();
    mesh.triangles = std::move(kept);
    return report;
}

} // namespace foam::repair
