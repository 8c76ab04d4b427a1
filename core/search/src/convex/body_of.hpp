// A solid as the search for convex elements sees it.
#pragma once

#include "cells.hpp"

#include <foam/geometry/solid.hpp>

namespace foam::inline search::convex {

/// A body and its unit frame: p = origin + unit · q.
struct BodyOfSolid {
    Body body;
    Vec3 origin{};
    double unit = 1; ///< m
};

/// Returns the body of a solid, which must outlive it. O(n log n).
BodyOfSolid body_of(const Solid& solid);

/// Returns bricks that hold the surface together: space is halved across the longest side of the brick with the
/// longest, again and again. Much quicker than bricks_of(), for elements that are larger than bricks.
std::vector<Brick> halved_bricks(const Body& body, std::size_t count);

} // namespace foam::inline search::convex
