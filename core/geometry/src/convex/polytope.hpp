// Polytopes whose faces move outwards.
#pragma once

#include <foam/geometry/element.hpp>

#include <span>

namespace foam::inline geometry {

/// Returns the mean of the faces' middles by area: well inside, even where many vertices are close together.
Vec3 inner_point(const Polytope& hull);

/// Returns a polytope with no more vertices that contains the given one with each face moved outwards by its length. It
/// also contains everything within `length` of the polytope and of `points`. The moves are the shortest of each vertex
/// beyond the planes at it, which is the same as planes moved if three planes meet there. Null if rounding does not
/// allow it.
std::shared_ptr<const Polytope> with_faces_moved(const Polytope& hull, std::span<const double> lengths,
                                                 std::span<const Vec3> points, double length);

/// Returns a polytope with no more vertices that contains everything within `length` of the hull: larger about its
/// middle if that is little, else with its faces moved. Throws Error(geometry) if it is too thin for either.
std::shared_ptr<const Polytope> with_room(const Polytope& hull, double length);

} // namespace foam::geometry
