// A solid in convex cells of space.
#pragma once

#include "bricks.hpp"

#include <foam/geometry/solid.hpp>

#include <functional>

namespace foam::inline search::convex {

/// A surface in units, and what is known of its inside.
struct Body {
    Polygons surface;
    std::vector<std::uint32_t> vertices; ///< of each corner of the surface, the number of its vertex
    bool has_inside = false;                 ///< also of an open surface that encloses most of a volume
    bool volumes_by_surface = false;         ///< the surface tells the volumes of the body's parts
    std::function<bool(const Vec3&)> inside; ///< whether a point is within the surface
    std::vector<Vec3> samples;               ///< points evenly spread inside, where the surface tells no volumes
    double sample_volume = 0;                ///< cubic units that each of them stands for
    std::vector<Plane> creases;              ///< planes through concave edges, important ones first
};

/// Returns bricks that hold the body together, about `most` of them: space is cut by planes, cells with more volume
/// between their part of the body and its hull than a threshold once more, and the threshold is lowered round by round.
/// A cell's plane is the one of those through concave edges and across the cell's axes whose two hulls have least
/// volume together.
std::vector<Brick> bricks_of(const Body& body, std::size_t most);

} // namespace foam::inline search::convex
