// Proofs that elements cover a solid: with statistics, and up to the first gap.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

struct CoverProof {
    Certificate certificate;
    std::size_t triangles = 0;  ///< of the proved surface; round primitives by the polyhedron around them
    std::uint32_t halvings = 0; ///< most halvings and cuts at creases of a piece
};

/// Runs the proof of certify().
CoverProof prove_cover(const Solid& solid, const Elements& elements, int depth = 40);

/// Runs the proof of certify() up to the first gap. If there is one, the certificate does not hold, and its other
/// figures mean nothing: the worst gap takes many times as long to find.
Certificate certify_to_first_gap(const Solid& solid, const Elements& elements);

/// Returns pieces of the triangles of `surface`. Every point of the surface lies in a piece, or at least 10⁻⁹ of the
/// surface's size inside the spheres. Pieces that cross the boundary of the spheres have edges of at most 1/500 of the
/// surface's size. No triangle is left if the spheres are proved to cover the surface. Precondition: check_corners().
Mesh left_uncovered(const Mesh& surface, const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
