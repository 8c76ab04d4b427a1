// The proof that spheres cover a solid, with statistics.
#pragma once

#include <foam/geometry/measure.hpp>

#include <cstdint>
#include <span>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

struct CoverProof {
    Certificate certificate;
    std::size_t triangles = 0;  ///< of the proved surface; round primitives by the polyhedron around them
    std::uint32_t halvings = 0; ///< most halvings and cuts at creases of a piece
};

/// Runs the proof of certify().
CoverProof prove_cover(const Solid& solid, std::span<const Sphere> spheres, int depth = 40);

} // namespace geometry
} // namespace foam
