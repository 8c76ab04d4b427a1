// What a mesh filter did to its input.
#pragma once

#include <foam/mesh.hpp>

#include <cstdint>
#include <optional>

namespace foam {

/// Distances from points of one surface to the other surface, in the unit of the meshes.
struct OneSidedDistance {
    double max = 0, mean = 0;

    bool operator==(const OneSidedDistance&) const = default;
};

/// A filter's output against its input.
struct MeshChange {
    std::size_t triangles_before = 0, triangles_after = 0;
    Topology before, after;           ///< defects; of the welded mesh unless it is sound as it is indexed
    OneSidedDistance input_to_output; ///< how far the input sticks out of, or lies off, the output
    OneSidedDistance output_to_input; ///< what the output added
    std::optional<double> volume_before, volume_after; ///< m³, signed; absent unless closed and oriented

    /// The two-sided (Hausdorff) distance, sampled.
    double distance() const {
        return input_to_output.max > output_to_input.max ? input_to_output.max : output_to_input.max;
    }
    /// (after - before) / |before|; absent if one of the volumes is.
    std::optional<double> volume_change() const;
};

/// Compares the two meshes. The distances are sampled in both directions, as in Cignoni, Rocchini, Scopigno: Metro,
/// 1998: `points` points uniform by area and as many vertices, so a maximum is met from below. Equal meshes are not
/// sampled. Deterministic for a seed. O((n + points) log n).
/// Precondition: finite vertices, indices in range, a triangle in each.
MeshChange mesh_change(const Mesh& before, const Mesh& after, std::uint64_t seed, std::size_t points = 500);

/// Proves that every point of `surface` is at most `distance` away from `other`: a piece of a triangle all of whose
/// corners are that near to one triangle of `other` is, since the points near a triangle are a convex set; other pieces
/// are split and asked again. False as soon as a point is found that is farther, or after 40 splits of a piece.
/// Preconditions as of mesh_change().
bool lies_within(double distance, const Mesh& surface, const Mesh& other);

/// One line for people: "1204 → 240 triangles, distance 0.31 mm, volume -0.4 %".
std::string describe(const MeshChange& change);

} // namespace foam
