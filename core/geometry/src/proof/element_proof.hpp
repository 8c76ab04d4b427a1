// The proof that convex elements cover a surface.
#pragma once

#include "proof/bodies.hpp"

#include <foam/geometry/internal/proof.hpp>
#include <foam/geometry/solid.hpp>

#include <vector>

namespace foam::inline geometry {

/// The triangles of a surface that no single body contains.
class OpenTriangles {
public:
    /// `pieces`: of the solid, relative to its centre.
    OpenTriangles(const Solid& solid, const Elements& elements, const Balls& pieces, const Bodies& bodies);

    /// Triangles, ascending.
    const std::vector<std::uint32_t>& triangles() const { return open_; }

private:
    void find_contained_parts(const Solid& solid, const Elements& elements, const Balls& pieces,
                              const Bodies& bodies);
    void find_holders(const Solid& solid, const Bodies& bodies);
    bool held_by_one(const Triangle& triangle, const Balls& pieces, const Bodies& bodies, std::uint32_t t) const;

    std::vector<std::uint32_t> holders_; ///< bodies that hold each vertex
    std::vector<std::size_t> ends_;      ///< for each vertex, end of its bodies in holders_
    std::vector<char> contained_;        ///< for each triangle; empty: none is known to be
    std::vector<std::uint32_t> open_;
};

/// Runs the proof for balls: a ball that contains the three corners contains the triangle.
CoverProof prove_cover_by_spheres(const Solid& solid, std::span<const Sphere> spheres, int depth);

/// Returns whether the element contains a primitive at the same pose, by comparing their numbers.
bool contains_by_lengths(const Element& element, const Solid::Part& part);

} // namespace foam::geometry
