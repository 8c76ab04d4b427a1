#include "soup.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/solid.hpp>

#include <algorithm>
#include <numeric>

namespace foam::repair {
namespace {

/// Returns for side k of triangle i, at 3 i + k, the other triangle at an edge with exactly two; no_index elsewhere.
std::vector<std::uint32_t> partners(const Mesh& mesh) {
    std::vector<std::uint32_t> result(3 * mesh.triangles.size(), no_index);
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
    CancellationCounter asking(4096);
    for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
        asking.check();
        if (seen[seed]) {
            continue;
        }
        std::vector<std::uint32_t>& patch = patches.emplace_back(1, seed);
        seen[seed] = 1;
        for (std::size_t next = 0; next < patch.size(); ++next) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t other = partner[3 * patch[next] + k];
                if (other != no_index && !seen[other]) {
                    seen[other] = 1;
                    patch.push_back(other);
                }
            }
        }
    }
    return patches;
}

enum class Facing { outwards, inwards, wall };

/// How often the inside is behind, in front, or on both sides of a patch.
struct Sides {
    std::size_t outwards = 0, inwards = 0, walls = 0;

    void look(const Solid& solid, const Vec3& point, const Vec3& step) {
        const bool before = solid.contains(point + step), behind = solid.contains(point - step);
        outwards += behind && !before;
        inwards += before && !behind;
        walls += before && behind;
    }
};

/// Returns at most `most` triangles of `patch`, largest first, ties in the order of the patch.
std::vector<std::uint32_t> largest(const Mesh& mesh, const std::vector<std::uint32_t>& patch, std::size_t most) {
    std::vector<std::pair<double, std::uint32_t>> by_area; // negated
    by_area.reserve(patch.size());
    for (std::uint32_t k = 0; k < patch.size(); ++k) {
        by_area.emplace_back(-squared_norm(area_vector(corners(mesh, mesh.triangles[patch[k]]))), k);
    }
    const std::size_t count = std::min(most, patch.size());
    std::partial_sort(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count), by_area.end());
    std::vector<std::uint32_t> result(count);
    std::transform(by_area.begin(), by_area.begin() + static_cast<std::ptrdiff_t>(count), result.begin(),
                   [&](const auto& entry) { return patch[entry.second]; });
    return result;
}

/// Samples the whole `patch`, in the middle and near the corners of every triangle.
Sides all_sides(const Mesh& mesh, const std::vector<std::uint32_t>& patch, const Solid& solid, double step) {
    constexpr double near = 0.98; // share of the way from the middle to a corner
    Sides sides;
    for (const std::uint32_t i : patch) {
        const Corners t = corners(mesh, mesh.triangles[i]);
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3, ahead = normalized(area_vector(t)) * step;
        sides.look(solid, middle, ahead);
        for (const Vec3& corner : t) {
            sides.look(solid, middle + (corner - middle) * near, ahead);
        }
    }
    return sides;
}

/// Returns the facing by the winding number in front of and behind the middles of the patch's largest triangles. A
/// patch is a wall only if no part of it sees the outside: a body that is mostly in another one still counts where it
/// emerges.
Facing facing_of(const Mesh& mesh, const std::vector<std::uint32_t>& patch, const Solid& solid) {
    constexpr std::size_t most_samples = 9;
    const double step = 1e-6 * solid.bounds().diagonal();
    const std::vector<std::uint32_t> samples = largest(mesh, patch, most_samples);
    Sides sides;
    for (const std::uint32_t i : samples) {
        const Corners t = corners(mesh, mesh.triangles[i]);
        sides.look(solid, (t[0] + t[1] + t[2]) / 3, normalized(area_vector(t)) * step);
    }
    if (2 * sides.walls > samples.size()) {
        sides = all_sides(mesh, patch, solid, step);
        if (sides.outwards + sides.inwards == 0) {
            return Facing::wall;
        }
        return sides.inwards > sides.outwards ? Facing::inwards : Facing::outwards;
    }
    return 2 * sides.inwards > samples.size() ? Facing::inwards : Facing::outwards;
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
