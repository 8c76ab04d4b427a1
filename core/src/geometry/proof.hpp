// The proof of cover, and what it took.
#pragma once

#include <foam/measure.hpp>

#include <cstdint>
#include <span>

namespace foam::geometry {

struct CoverProof {
    Certificate certificate;
    std::size_t triangles = 0;  ///< of the surface that is proved; round primitives by the polyhedron around them
    std::uint32_t halvings = 0; ///< of the piece that was cut most often, cuts at creases among them
};

/// What certify() does.
CoverProof prove_cover(const Solid& solid, std::span<const Sphere> spheres, int depth = 40);

} // namespace foam::geometry
