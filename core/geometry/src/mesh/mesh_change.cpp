#include <foam/geometry/mesh_change.hpp>

#include "mesh/surface_points.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/compared_mesh.hpp>

#include <fmt/format.h>

namespace foam::inline geometry {
namespace {


/// Returns points spread over the area, and vertices spread over their indices.
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

OneSidedDistance one_sided(const std::vector<Vec3>& from, ComparedMesh& to) {
    to.prepare_distances();
    std::vector<double> distances(from.size());
    parallel_for(from.size(), [&](std::size_t i) { distances[i] = to.distance(from[i]); });
    OneSidedDistance result;
    for (const double d : distances) {
        result.max = std::max(result.max, d);
        result.mean += d / static_cast<double>(distances.size());
    }
    return result;
}

} // namespace

std::optional<double> MeshChange::volume_change() const {
    if (!volume_before || !volume_after || *volume_before == 0) {
        return std::nullopt;
    }
    return (*volume_after - *volume_before) / std::abs(*volume_before);
}

MeshChange mesh_change(ComparedMesh& before, ComparedMesh& after, std::uint64_t seed, std::size_t points) {
    const Mesh &input = before.mesh(), &output = after.mesh();
    MeshChange change;
    change.triangles_before = input.triangles.size();
    change.triangles_after = output.triangles.size();
    change.before = before.defects();
    change.volume_before = before.volume();
    if (input == output || before.welded() == output) {
        change.after = change.before;
        change.volume_after = change.volume_before;
        return change;
    }
    change.after = after.defects();
    change.volume_after = after.volume();
    change.input_to_output = one_sided(probes(input, points, seed), after);
    change.output_to_input = one_sided(probes(output, points, seed), before);
    return change;
}

MeshChange mesh_change(const Mesh& before, const Mesh& after, std::uint64_t seed, std::size_t points) {
    ComparedMesh input(before), output(after);
    return geometry::mesh_change(input, output, seed, points);
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

} // namespace foam::geometry
