#include "octree.hpp"

#include "soup.hpp"

#include <foam/base/parallel.hpp>

namespace foam::repair {
namespace {

/// Depth below the surface, in cells, at which a solid is distinguished from a sheet.
constexpr double probe_depth = 0.01;

class Projection {
public:
    Projection(VoxelSurface& surface, const Nearby& nearby, const Solid& solid, double cell,
               const ProjectOptions& options, Context& context)
        : surface_(surface), mesh_(surface.mesh), nearby_(nearby), solid_(solid), cell_(cell), options_(options),
          context_(context), stand_off_(mesh_.vertices.size(), 0) {}

    double run() {
        collect_rings();
        for (int round = 0; round < options_.rounds; ++round) {
            context_.check_cancelled();
            find_targets(round == 0);
            for (std::uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
                move(i);
            }
        }
        improve_diagonals();
        const auto sheets = std::count(stand_off_.begin(), stand_off_.end(), options_.off_sheets * cell_);
        return static_cast<double>(sheets) / static_cast<double>(stand_off_.size());
    }

private:
    void collect_rings() {
        rings_.resize(mesh_.vertices.size());
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                rings_[corner].push_back(t);
            }
        }
    }

    Vec3 ring_normal(std::uint32_t vertex) const {
        Vec3 sum;
        for (const std::uint32_t t : rings_[vertex]) {
            sum += area_vector(corners(mesh_, mesh_.triangles[t]));
        }
        return normalized(sum);
    }

    Vec3 ring_center(std::uint32_t vertex) const {
        Vec3 sum;
        for (const std::uint32_t t : rings_[vertex]) {
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                sum += corner == vertex ? Vec3{} : mesh_.vertices[corner];
            }
        }
        return sum / (2.0 * static_cast<double>(rings_[vertex].size()));
    }

    /// Returns whether the surface around the vertex is nearly flat, so that sliding along it loses no edge.
    bool is_flat(std::uint32_t vertex) const {
        const Vec3 normal = ring_normal(vertex);
        return std::all_of(rings_[vertex].begin(), rings_[vertex].end(), [&](std::uint32_t t) {
            const Vec3 n = area_vector(corners(mesh_, mesh_.triangles[t]));
            return dot(n, normal) > 0.9 * norm(n);
        });
    }

    void find_targets(bool first) {
        targets_ = mesh_.vertices;
        parallel_for(targets_.size(), [&](std::size_t index) {
            const auto i = static_cast<std::uint32_t>(index);
            if (!nearby_.none(i)) {
                targets_[i] = above_input(i, first);
            } else if (!first) { // closes an opening: there is no input to project to
                targets_[i] = (mesh_.vertices[i] + ring_center(i)) * 0.5;
            }
        });
    }

    /// Returns the target of the vertex: slid towards its neighbours' mean, then projected to the input.
    Vec3 above_input(std::uint32_t i, bool first) {
        const Vec3 p = mesh_.vertices[i];
        Vec3 base = p;
        if (!first && is_flat(i)) {
            const Vec3 normal = ring_normal(i), shift = ring_center(i) - p;
            base += (shift - normal * dot(shift, normal)) * 0.5;
        }
        const Foot foot = nearby_.closest(i, base);
        const bool has_side = foot.distance > 1e-4 * cell_;
        const Vec3 away = has_side ? (base - foot.point) / foot.distance : ring_normal(i);
        if (first) {
            const bool on_solid = solid_.contains(foot.point - away * (probe_depth * cell_));
            stand_off_[i] = (on_solid ? options_.off_solids : options_.off_sheets) * cell_;
        }
        for (const double sign : {1.0, -1.0}) { // sliding around an edge may have led to the wrong side
            const Vec3 target = foot.point + away * (sign * stand_off_[i]);
            if (!nearby_.is_crossed(i, p, target)) {
                return target;
            }
        }
        return p;
    }

    /// Returns whether all triangles at the vertex keep their orientation when it is at `to`.
    bool is_allowed(std::uint32_t vertex, const Vec3& to) const {
        const double least = 1e-4 * cell_ * cell_;
        return std::all_of(rings_[vertex].begin(), rings_[vertex].end(), [&](std::uint32_t t) {
            Corners c = corners(mesh_, mesh_.triangles[t]);
            const Vec3 before = area_vector(c);
            for (std::size_t k = 0; k < 3; ++k) {
                if (mesh_.triangles[t][k] == vertex) {
                    c[k] = to;
                }
            }
            const Vec3 after = area_vector(c);
            return dot(before, after) > 0.2 * norm(before) * norm(after) && norm(after) > least;
        });
    }

    void move(std::uint32_t vertex) {
        const Vec3 from = mesh_.vertices[vertex];
        for (const double step : {1.0, 0.5, 0.25}) {
            const Vec3 to = from + (targets_[vertex] - from) * step;
            if (is_allowed(vertex, to)) {
                mesh_.vertices[vertex] = to;
                return;
            }
        }
    }

    /// Chooses for each face the diagonal whose middle is nearer to the input.
    void improve_diagonals() {
        std::vector<char> change(surface_.quads.size(), 0);
        parallel_for(surface_.quads.size(), [&](std::size_t i) {
            const std::array<std::uint32_t, 4>& c = surface_.quads[i].corners;
            const auto error = [&](std::uint32_t a, std::uint32_t b) {
                const Foot foot = nearby_.closest(a, (mesh_.vertices[a] + mesh_.vertices[b]) * 0.5);
                return foot.distance;
            };
            change[i] = error(c[1], c[3]) < 0.999 * error(c[0], c[2]) && is_convex(c);
        });
        for (std::size_t i = 0; i < change.size(); ++i) {
            if (change[i]) {
                const auto& [quad, first] = surface_.quads[i];
                mesh_.triangles[first] = {quad[1], quad[2], quad[3]};
                mesh_.triangles[first + 1] = {quad[3], quad[0], quad[1]};
            }
        }
    }

    /// Returns whether both triangles of the other diagonal face the way of the present ones.
    bool is_convex(const std::array<std::uint32_t, 4>& c) const {
        const auto normal = [&](std::size_t i, std::size_t j, std::size_t k) {
            return area_vector({mesh_.vertices[c[i]], mesh_.vertices[c[j]], mesh_.vertices[c[k]]});
        };
        const Vec3 mean = normalized(normal(0, 1, 2) + normal(2, 3, 0));
        const double least = 1e-4 * cell_ * cell_;
        return dot(normal(1, 2, 3), mean) > least && dot(normal(3, 0, 1), mean) > least;
    }

    VoxelSurface& surface_;
    Mesh& mesh_;
    const Nearby& nearby_;
    const Solid& solid_;
    double cell_;
    const ProjectOptions& options_;
    Context& context_;
    std::vector<double> stand_off_;                 // of each vertex
    std::vector<std::vector<std::uint32_t>> rings_; // of each vertex: its triangles
    std::vector<Vec3> targets_;
};

} // namespace

double project(VoxelSurface& surface, const Nearby& nearby, const Solid& solid, double cell,
               const ProjectOptions& options, Context& context) {
    return Projection(surface, nearby, solid, cell, options, context).run();
}

} // namespace foam::repair
