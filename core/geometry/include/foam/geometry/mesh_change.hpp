// The difference between the input and the output of a mesh filter.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <cstdint>
#include <optional>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Distances from points of one surface to the other surface, in the unit of the meshes.
struct OneSidedDistance {
    double max = 0, mean = 0;

    bool operator==(const OneSidedDistance&) const = default;
};

/// A filter's output against its input.
struct MeshChange {
    std::size_t triangles_before = 0, triangles_after = 0;
    Topology before, after;           ///< defects; of the welded mesh unless the mesh is sound as it is indexed
    OneSidedDistance input_to_output; ///< how far the input extends beyond, or lies off, the output
    OneSidedDistance output_to_input; ///< what the output added
    std::optional<double> volume_before, volume_after; ///< m³, signed; absent unless closed and oriented

    /// Returns the two-sided (Hausdorff) distance, sampled.
    double distance() const {
        return input_to_output.max > output_to_input.max ? input_to_output.max : output_to_input.max;
    }
    /// Returns (after - before) / |before|; absent if one of the volumes is.
    std::optional<double> volume_change() const;
};

/// Compares the two meshes. The distances are sampled in both directions, as in Cignoni, Rocchini, Scopigno: Metro,
/// 1998: `points` points uniform by area and as many vertices, so a maximum is approached from below. Equal meshes are
/// not sampled. Deterministic for a seed. O((n + points) log n).
/// Precondition: finite vertices, indices in range, a triangle in each.
MeshChange mesh_change(const Mesh& before, const Mesh& after, std::uint64_t seed, std::size_t points = 500);

/// Proves that every point of `surface` is at most `distance` away from `other`. A piece of a triangle passes if all
/// its corners are that near to one triangle of `other`, since the points near a triangle are a convex set. Other
/// pieces are split and tested again. False as soon as a farther point is found, or after 40 splits of a piece.
/// Preconditions as for mesh_change().
bool lies_within(double distance, const Mesh& surface, const Mesh& other);

/// Returns one line for people: "1204 → 240 triangles, distance 0.31 mm, volume -0.4 %".
std::string describe(const MeshChange& change);

} // namespace geometry
} // namespace foam
