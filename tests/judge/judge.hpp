// Whether spheres keep their guarantee, asked point by point.
#pragma once

#include "robot.hpp"

#include <optional>

namespace judge {

/// A point that speaks against a guarantee.
struct Objection {
    Point point;       ///< of the geometry outside all spheres, or of a sphere outside the geometry; link frame, m
    Real distance = 0; ///< outer: to the nearest sphere, m; inner: to the surface, m
};

/// A point of the surface that lies in no ball: of those asked, the farthest out. Asked are corners, middles of edges,
/// a lattice on every triangle, and just beyond every place where the surface can leave the union of the balls: where
/// an edge leaves a ball, where two balls leave the triangle's plane, and where one ends within it.
std::optional<Objection> outside_of_balls(const Link& link, const std::vector<Ball>& balls);

/// A point of a ball that lies outside the geometry: the ball's centre, points spread over its surface, and the one
/// towards the nearest triangle of each part. Inside is what lies in a round primitive, or where the solid angle under
/// which the triangles of a part are seen is above half of the full one.
std::optional<Objection> outside_of_solid(const Link& link, const std::vector<Ball>& balls);

/// Whether inside and outside of all its meshes are beyond doubt: every edge of a mesh is shared by two triangles that
/// run it in opposite directions, no triangle is there twice, and its connected pieces are wound alike.
bool plain(const Link& link);

} // namespace judge
