#include "project.hpp"

#include "triangle.hpp"

#include <foam/parallel.hpp>

#include <limits>

namespace foam::watertight {
namespace {

/// The point of the input nearest to a vertex, and what it is on.
struct Foot {
    Vec3 point, normal;
    double distance = std::numeric_limits<double>::infinity();
};

class Projection {
public:
    Projection(VoxelSurface& surface, const Mesh& input, const Octree& octree, const ProjectOptions& options,
               Context& context)
        : surface_(surface), mesh_(surface.mesh), octree_(octree), options_(options), context_(context) {
        input_.reserve(input.triangles.size());
        for (const Triangle& t : input.triangles) {
            input_.push_back(corners(input, t));
        }
    }

    void run() {
        collect_rings();
        collect_candidates();
        for (int round = 0; round < options_.rounds; ++round) {
            context_.check_cancelled();
            find_targets(round > 0);
            for (std::uint32_t i = 0; i < mesh_.vertices.size(); ++i) {
                move(i);
            }
        }
        improve_diagonals();
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

    /// For each vertex the input's triangles in the solid cells around it: its own cells and those joined to them
    /// across faces within the eight cells at the vertex. What lies behind a pinch does not count.
    void collect_candidates() {
        candidates_.resize(mesh_.vertices.size());
        parallel_for(mesh_.vertices.size(), [&](std::size_t i) {
            std::vector<Cell> cells = surface_.cells[i];
            const Vec3 p = mesh_.vertices[i] / octree_.cell_size();
            for (std::size_t k = 0; k < cells.size(); ++k) {
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    for (const int step : {-1, 1}) {
                        Cell next = cells[k];
                        next[axis] += step;
                        const bool near = std::abs(next[axis] + 0.5 - p[static_cast<int>(axis)]) < 1.25;
                        if (near && octree_.is_solid(next) &&
                            std::find(cells.begin(), cells.end(), next) == cells.end()) {
                            cells.push_back(next);
                        }
                    }
                }
            }
            std::vector<std::uint32_t>& list = candidates_[i];
            for (const Cell& cell : cells) {
                const auto triangles = octree_.triangles_at(cell);
                list.insert(list.end(), triangles.begin(), triangles.end());
            }
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        });
    }

    Foot closest(std::uint32_t vertex, const Vec3& p) const {
        Foot foot;
        double least = foot.distance;
        for (const std::uint32_t t : candidates_[vertex]) {
            const Vec3 q = closest_point(input_[t], p);
            const double d = squared_norm(p - q);
            if (d < least) {
                least = d;
                foot.point = q;
                foot.normal = area_vector(input_[t]);
            }
        }
        foot.distance = std::sqrt(least);
        foot.normal = normalized(foot.normal);
        return foot;
    }

    bool passes_through_input(std::uint32_t vertex, const Vec3& a, const Vec3& b) const {
        return std::any_of(candidates_[vertex].begin(), candidates_[vertex].end(),
                           [&](std::uint32_t t) { return crosses(input_[t], a, b); });
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

    /// The surface around the vertex is nearly flat: sliding along it loses no edge.
    bool is_flat(std::uint32_t vertex) const {
        const Vec3 normal = ring_normal(vertex);
        return std::all_of(rings_[vertex].begin(), rings_[vertex].end(), [&](std::uint32_t t) {
            const Vec3 n = area_vector(corners(mesh_, mesh_.triangles[t]));
            return dot(n, normal) > 0.9 * norm(n);
        });
    }

    void find_targets(bool smooth) {
        targets_.resize(mesh_.vertices.size());
        parallel_for(mesh_.vertices.size(), [&](std::size_t index) {
            const auto i = static_cast<std::uint32_t>(index);
            const Vec3 p = mesh_.vertices[i];
            targets_[i] = p;
            Vec3 base = p;
            if (smooth && is_flat(i)) {
                const Vec3 normal = ring_normal(i);
                const Vec3 shift = ring_center(i) - p;
                base = p + (shift - normal * dot(shift, normal)) * 0.5;
            }
            if (candidates_[i].empty()) { // closes an opening: there is nothing to be drawn to
                targets_[i] = smooth ? p + (ring_center(i) - p) * 0.5 : p;
                return;
            }
            const Foot foot = closest(i, base);
            Vec3 away =
                foot.distance > 0.01 * options_.stand_off ? (base - foot.point) / foot.distance : ring_normal(i);
            for (const double sign : {1.0, -1.0}) {
                const Vec3 target = foot.point + away * (sign * options_.stand_off);
                if (!passes_through_input(i, p, target)) {
                    targets_[i] = target;
                    return;
                }
            }
        });
    }

    /// All triangles at the vertex keep their side when it is at `to`.
    bool is_allowed(std::uint32_t vertex, const Vec3& to) const {
        const double least = 1e-4 * octree_.cell_size() * octree_.cell_size();
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

    /// Of the two diagonals of a face, the one whose triangles agree better with the input: their middles lie nearer to
    /// it.
    void improve_diagonals() {
        std::vector<char> change(surface_.quads.size(), 0);
        parallel_for(surface_.quads.size(), [&](std::size_t i) {
            const std::array<std::uint32_t, 4>& c = surface_.quads[i].corners;
            const auto error = [&](std::uint32_t a, std::uint32_t b) {
                const Foot foot = closest(a, (mesh_.vertices[a] + mesh_.vertices[b]) * 0.5);
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

    /// Both triangles of the other diagonal face the way the present ones do.
    bool is_convex(const std::array<std::uint32_t, 4>& c) const {
        const auto normal = [&](std::size_t i, std::size_t j, std::size_t k) {
            return area_vector({mesh_.vertices[c[i]], mesh_.vertices[c[j]], mesh_.vertices[c[k]]});
        };
        const Vec3 mean = normalized(normal(0, 1, 2) + normal(2, 3, 0));
        const double least = 1e-4 * octree_.cell_size() * octree_.cell_size();
        return dot(normal(1, 2, 3), mean) > least && dot(normal(3, 0, 1), mean) > least;
    }

    VoxelSurface& surface_;
    Mesh& mesh_;
    const Octree& octree_;
    const ProjectOptions& options_;
    Context& context_;
    std::vector<Corners> input_;
    std::vector<std::vector<std::uint32_t>> rings_;      // of each vertex: its triangles
    std::vector<std::vector<std::uint32_t>> candidates_; // of each vertex: the input's triangles near it
    std::vector<Vec3> targets_;
};

} // namespace

void project(VoxelSurface& surface, const Mesh& input, const Octree& octree, const ProjectOptions& options,
             Context& context) {
    Projection(surface, input, octree, options, context).run();
}

} // namespace foam::watertight
