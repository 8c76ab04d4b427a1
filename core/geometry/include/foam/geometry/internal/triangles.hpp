// Triangles: what they are, where they cross, which corners coincide, how two meshes compare.
#pragma once

#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/geometry/vector.hpp>

#include <array>
#include <optional>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// The corners, copied from the mesh so that queries read memory in order.
struct Corners {
    Vec3 a, b, c;
};

/// Returns the point of the triangle nearest to `p` (Ericson, Real-Time Collision Detection 2005, section 5.1.5).
/// Degenerate triangles are segments or points.
Vec3 closest_on_triangle(const Corners& t, const Vec3& p);

/// Returns the solid angle of the triangle seen from `p`, in steradians divided by 4π: its share of the winding number.
/// Positive if `p` is behind the triangle. Van Oosterom and Strackee 1983, equation 8.
double winding_of_triangle(const Corners& t, const Vec3& p);

using TriangleCorners = std::array<Vec3, 3>;

/// Returns whether a side of one triangle passes through the interior of the other, as far as orientation tests in
/// double precision are certain of their sign (Shewchuk: Adaptive Precision Floating-Point Arithmetic, 1997,
/// section 4.3), even if every coordinate is off by a unit in the last place. `shared`: corners that are corners of the
/// other triangle; it is only touched there.
bool side_passes_through(const TriangleCorners& sides, const TriangleCorners& other,
                         const std::array<bool, 3>& shared = {});

/// Returns, for every vertex, the smallest index of a vertex at the same position (-0 equals 0).
std::vector<std::uint32_t> welded_indices(const Mesh& mesh);

/// Disjoint sets of the numbers below `count`, with path halving. The smallest member represents its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count);
    std::uint32_t find(std::uint32_t i);
    void unite(std::uint32_t a, std::uint32_t b);
    /// Returns the number of sets.
    std::size_t count() const;

private:
    std::vector<std::uint32_t> parent_;
};

/// Computes each quantity once, on first use: in a chain of filters every mesh is compared twice, with its predecessor
/// and with its successor. Only distance() may be called by several threads at once.
class ComparedMesh {
public:
    /// `mesh` must outlive this. Precondition: as for mesh_change().
    explicit ComparedMesh(const Mesh& mesh) : mesh_(mesh) {}

    const Mesh& mesh() const { return mesh_; }
    const Mesh& welded();
    /// Returns the defects of the mesh as it is indexed, if that is sound: bodies that touch may have vertices at one
    /// place. Else returns those of the mesh with equal vertices welded: raw files give every triangle its own.
    const Topology& defects();
    /// Returns the signed volume; absent unless closed and oriented.
    std::optional<double> volume();
    /// Builds the hierarchy. Call it before the first call of distance().
    void prepare_distances();
    /// Returns the distance from the point to the surface.
    double distance(const Vec3& point) const;

private:
    const Mesh& mesh_;
    std::optional<Mesh> welded_;
    std::optional<Topology> defects_;
    std::optional<Bvh> bvh_;
};

/// See foam::mesh_change().
MeshChange mesh_change(ComparedMesh& before, ComparedMesh& after, std::uint64_t seed, std::size_t points = 500);

} // namespace geometry
} // namespace foam
