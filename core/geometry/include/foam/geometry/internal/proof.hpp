// Proofs that elements cover a solid: with statistics, and up to the first gap.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>
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

/// Runs the proof of certify() for the surface alone, up to the first gap.
Certificate certify_surface(const Solid& solid, const Elements& elements);

/// Runs the proof of certify() up to the first gap. If there is one, the certificate does not hold, and its other
/// figures mean nothing: the worst gap takes many times as long to find.
Certificate certify_to_first_gap(const Solid& solid, const Elements& elements);

/// The result of the proof that elements leave no cavity in a solid.
struct SolidProof {
    /// A part of an element's surface that lies inside the solid and in no other element, as far as is proved.
    struct Open {
        std::uint32_t element = 0;
        std::vector<Vec3> points; ///< whose hull holds the part, and one beside it
    };
    bool holds = false;
    bool found = false; ///< there is a cavity
    Vec3 witness{};     ///< of the solid; outside all elements if `found`
    double depth = 0;   ///< m, its distance from them
    std::size_t pieces = 0;
    std::vector<Open> open;
};

/// Proves that elements which hold the surface of a solid hold the solid: that they leave no cavity in it. Parts that are
/// not closed have no inside. docs/dev/certificate.md has the argument. `all`: finds all open parts, else it stops at
/// the first one.
SolidProof prove_solid(const Solid& solid, const Elements& elements, bool all = false);

/// Proves that the union of elements has no void: the space outside of it is connected. Returns false if it has one, or
/// if that is in doubt. docs/dev/certificate.md has the argument.
bool has_no_void(const Elements& elements);

/// Returns pieces of the triangles of `surface`. Every point of the surface lies in a piece, or at least 10⁻⁹ of the
/// surface's size inside the spheres. Pieces that cross the boundary of the spheres have edges of at most 1/500 of the
/// surface's size. No triangle is left if the spheres are proved to cover the surface. Precondition: check_corners().
Mesh left_uncovered(const Mesh& surface, const std::vector<Sphere>& spheres);

} // namespace geometry
} // namespace foam
