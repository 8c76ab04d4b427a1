#include <foam/geometry/mesh_checks.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/solid.hpp>

#include <fmt/format.h>

namespace foam::inline geometry {
namespace {

/// Returns one point in each of `count` equal shares of the area, in the order of the triangles, placed in its triangle
/// by the map of Osada, Funkhouser, Chazelle, Dobkin 2002, equation 1. Precondition: at least one triangle.
std::vector<SurfacePoint> sampled_surface(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<double> up_to; // area of the triangles up to and including this one
    up_to.reserve(mesh.triangles.size());
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        sum += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
        up_to.push_back(sum);
    }
    Random random(derive_seed(seed, "sample_surface"));
    std::vector<SurfacePoint> points;
    points.reserve(count);
    std::size_t triangle = 0;
    double first = random.uniform(), second = random.uniform();
    CancellationCounter asking(4096);
    for (std::size_t i = 0; i < count; ++i) {
        asking.check();
        const double at = (static_cast<double>(i) + random.uniform()) / static_cast<double>(count) * sum;
        while (triangle + 1 < up_to.size() && !(at < up_to[triangle])) {
            ++triangle;
        }
        const auto& [ia, ib, ic] = mesh.triangles[triangle];
        const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
        first += 0.7548776662466927;
        first -= first >= 1 ? 1 : 0;
        second += 0.5698402909980532;
        second -= second >= 1 ? 1 : 0;
        const double root = std::sqrt(first), v = second;
        points.push_back({a + (b - a) * (root * (1 - v)) + (c - a) * (root * v), normalized(cross(b - a, c - a)),
                          static_cast<std::uint32_t>(triangle)});
    }
    return points;
}

/// Returns points spread over the area, and vertices spread over their indices.
std::vector<Vec3> probes(const Mesh& mesh, std::size_t count, std::uint64_t seed) {
    std::vector<Vec3> result;
    for (const SurfacePoint& point : sampled_surface(mesh, count, seed)) {
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

std::vector<SurfacePoint> Solid::sample_surface(std::size_t count, std::uint64_t seed) const {
    return sampled_surface(surface(), count, seed);
}

const Mesh& ComparedMesh::welded() {
    if (!welded_) {
        welded_ = foam::welded(mesh_);
    }
    return *welded_;
}

const Topology& ComparedMesh::defects() {
    if (!defects_) {
        defects_ = topology(mesh_);
        if (!defects_->closed_manifold()) {
            defects_ = topology(welded());
        }
    }
    return *defects_;
}

std::optional<double> ComparedMesh::volume() {
    return defects().closed() && defects().oriented() ? std::optional(signed_volume(mesh_)) : std::nullopt;
}

void ComparedMesh::prepare_distances() {
    if (bvh_) {
        return;
    }
    std::vector<Box> boxes(mesh_.triangles.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const std::uint32_t corner : mesh_.triangles[i]) {
            boxes[i].add(mesh_.vertices[corner]);
        }
    }
    check_cancelled();
    bvh_ = Bvh::quick(boxes, 8);
}

double ComparedMesh::distance(const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity(); // squared
    for_each_nearer(
        *bvh_, point, [&] { return least; },
        [&](std::uint32_t k) {
            const auto& [a, b, c] = mesh_.triangles[bvh_->order()[k]];
            const Corners corners{mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
            least = std::min(least, squared_norm(closest_on_triangle(corners, point) - point));
        });
    return std::sqrt(least);
}

} // namespace foam::inline geometry
