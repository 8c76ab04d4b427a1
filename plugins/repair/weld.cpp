#include "soup.hpp"

#include <foam/base/cancellation.hpp>

#include <bit>

namespace foam::repair {
namespace {

/// Returns for each axis the number of the cell of a point: an integer, possibly beyond the range of integer types.
Vec3 cell_of(const Vec3& p, double cell) {
    return {std::floor(p.x / cell), std::floor(p.y / cell), std::floor(p.z / cell)};
}

/// The kept vertices, in a hashed grid.
class Kept {
public:
    Kept(const std::vector<Vec3>& points, double tolerance)
        : points_(points), tolerance_(tolerance), mask_(std::bit_ceil(2 * points.size() + 1) - 1),
          newest_(mask_ + 1, no_index), older_(points.size(), no_index) {}

    /// Returns a kept vertex within the tolerance of the point: the first in the order of cells of the tolerance's size
    /// (z, y, x), then of vertices. no_index if there is none.
    std::uint32_t near(const Vec3& p) const {
        const Vec3 low = cell_of(p - Vec3{1, 1, 1} * tolerance_, cell()),
                   high = cell_of(p + Vec3{1, 1, 1} * tolerance_, cell());
        std::uint32_t best = no_index;
        for (double z = low.z; z <= high.z; ++z) {
            for (double y = low.y; y <= high.y; ++y) {
                for (double x = low.x; x <= high.x; ++x) {
                    for (std::uint32_t i = newest_[slot(x, y, z)]; i != no_index; i = older_[i]) {
                        if (i != best && distance(points_[i], p) <= tolerance_ &&
                            (best == no_index || comes_before(i, best))) {
                            best = i;
                        }
                    }
                }
            }
        }
        return best;
    }

    void add(std::uint32_t i) {
        const Vec3 at = cell_of(points_[i], cell());
        std::uint32_t& newest = newest_[slot(at.x, at.y, at.z)];
        older_[i] = newest;
        newest = i;
    }

private:
    /// Returns the cell size. It is large compared with the tolerance, so that most points have only one cell to
    /// search. A cell has few vertices, because kept vertices are no nearer to each other than the tolerance.
    double cell() const { return 8 * tolerance_; }

    std::size_t slot(double x, double y, double z) const {
        std::uint64_t hash = 0;
        for (const double value : {x, y, z}) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 0x9E3779B97F4A7C15u; // -0 becomes 0
            hash ^= hash >> 32;
        }
        return hash & mask_;
    }

    bool comes_before(std::uint32_t i, std::uint32_t k) const {
        const Vec3 a = cell_of(points_[i], tolerance_), b = cell_of(points_[k], tolerance_);
        return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x != b.x ? a.x < b.x : i < k;
    }

    const std::vector<Vec3>& points_;
    double tolerance_;
    std::size_t mask_;
    std::vector<std::uint32_t> newest_; // of the vertices in the cells of a slot
    std::vector<std::uint32_t> older_;  // the next one in its slot
};

} // namespace

Mesh welded_within(const Mesh& mesh, double tolerance) {
    if (!(tolerance > 0)) {
        return welded(mesh);
    }
    Kept kept(mesh.vertices, tolerance);
    std::vector<std::uint32_t> stands_for(mesh.vertices.size());
    CancellationCounter asking(4096);
    for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
        asking.check();
        stands_for[i] = kept.near(mesh.vertices[i]);
        if (stands_for[i] == no_index) {
            stands_for[i] = i;
            kept.add(i);
        }
    }
    Mesh result{mesh.vertices, {}};
    for (const auto& [a, b, c] : mesh.triangles) {
        result.triangles.push_back({stands_for[a], stands_for[b], stands_for[c]});
    }
    return welded(result);
}

} // namespace foam::repair
