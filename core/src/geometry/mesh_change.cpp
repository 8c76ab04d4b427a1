#include <foam/mesh_change.hpp>

#include "geometry/mesh_part.hpp"
#include "geometry/surface_points.hpp"

#include <foam/parallel.hpp>

#include <fmt/format.h>

namespace foam {
namespace {

using geometry::MeshPart;

/// The triangles for distance queries only: no reading as a solid.
MeshPart surface_of(const Mesh& mesh) {
    return {mesh, {std::vector(mesh.triangles.size(), geometry::Facing::as_given), true}};
}

/// Points spread over the area, and vertices spread over their numbers.
std::vector<Vec3> probes(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<Vec3> result;
    for (const SurfacePoint& point : geometry::sampled_surface(mesh, count, seed)) {
        result.push_back(point.point);
    }
    const std::size_t corners = 3 * mesh.triangles.size();
    for (std::size_t i = 0; i < std::min(count, corners); ++i) {
        const std::size_t corner = i * corners / std::min(count, corners);
        result.push_back(mesh.vertices[mesh.triangles[corner / 3][corner % 3]]);
    }
    return result;
}

OneSidedDistance one_sided(const std::vector<Vec3>& from, const MeshPart& to) {
    std::vector<double> distances(from.size());
    parallel_for(from.size(), [&](std::size_t i) {
        geometry::Nearest nearest{std::numeric_limits<double>::infinity()};
        to.closest(from[i], nearest);
        distances[i] = std::sqrt(nearest.squared_distance);
    });
    OneSidedDistance result;
    for (const double d : distances) {
        result.max = std::max(result.max, d);
        result.mean += d / static_cast<double>(distances.size());
    }
    return result;
}

/// Of the mesh as it is indexed if that is sound (bodies that touch may have vertices at one place), else after welding
/// equal vertices (raw files give every triangle vertices of its own).
Topology defects_of(const Mesh& mesh) {
    const Topology given = topology(mesh);
    return given.closed_manifold() ? given : topology(welded(mesh));
}

std::optional<double> volume(const Mesh& mesh, const Topology& defects) {
    return defects.closed() && defects.oriented() ? std::optional(signed_volume(mesh)) : std::nullopt;
}

} // namespace

std::optional<double> MeshChange::volume_change() const {
    if (!volume_before || !volume_after || *volume_before == 0) {
        return std::nullopt;
    }
    return (*volume_after - *volume_before) / std::abs(*volume_before);
}

MeshChange mesh_change(const Mesh& before, const Mesh& after, std::uint64_t seed, std::size_t points) {
    MeshChange change;
    change.triangles_before = before.triangles.size();
    change.triangles_after = after.triangles.size();
    change.before = defects_of(before);
    change.volume_before = volume(before, change.before);
    if (before == after || welded(before) == after) {
        change.after = change.before;
        change.volume_after = change.volume_before;
        return change;
    }
    change.after = defects_of(after);
    change.volume_after = volume(after, change.after);
    change.input_to_output = one_sided(probes(before, points, seed), surface_of(after));
    change.output_to_input = one_sided(probes(after, points, seed), surface_of(before));
    return change;
}

std::string describe(const MeshChange& change) {
    std::string text = change.triangles_before == change.triangles_after
                           ? fmt::format("{} triangles", change.triangles_after)
                           : fmt::format("{} → {} triangles", change.triangles_before, change.triangles_after);
    text +=
        change.distance() == 0 ? ", unchanged in place" : fmt::format(", distance {:.3g} mm", 1000 * change.distance());
    if (const auto volume = change.volume_change(); volume && change.distance() > 0) {
        text += fmt::format(", volume {:+.2g} %", 100 * *volume);
    }
    if (!change.before.closed_manifold()) {
        text += fmt::format("; was: {}", foam::describe(change.before));
    }
    if (!change.after.closed_manifold() && describe(change.after) != describe(change.before)) {
        text += fmt::format("; is: {}", foam::describe(change.after));
    }
    return text;
}

} // namespace foam
