// Whether written elements keep their guarantee, asked point by point.
#pragma once

#include "model.hpp"
#include "robot.hpp"

#include <optional>

namespace judge {

/// A point that speaks against a guarantee.
struct Objection {
    Point point; ///< of the geometry outside all elements, or of a sphere outside the geometry; link frame, m
    /// Outer: to the nearest element, m; for a hull it is a lower bound. Inner: to the surface, m.
    Real distance = 0;
};

/// A point of the surface that lies in no element: of those asked, the farthest out. Asked are
/// - corners, middles of edges, and a lattice on every triangle and round surface, finer where elements are small;
/// - from each place of the lattice that is farther out than those beside it, ever farther out by shrinking steps;
/// - just beyond every place where the surface can leave the elements: where an edge or a line across the triangle
///   leaves one; for balls also where two leave the triangle's plane, and where one ends within it.
/// Objected to is what lies farther out than the rounding of the part's pose to doubles explains, and own_rounding().
std::optional<Objection> outside_of_elements(const Link& link, const std::vector<Body>& elements);
std::optional<Objection> outside_of_balls(const Link& link, const std::vector<Ball>& balls);

/// A point of a ball that lies outside the geometry: the ball's centre, points spread over its surface, and the one
/// towards the nearest triangle of each part. Inside is what lies in a round primitive, or where the solid angle under
/// which the triangles of a part are seen is above half of the full one.
std::optional<Objection> outside_of_solid(const Link& link, const std::vector<Ball>& balls);

/// The volume of a solid that lies in no element.
struct Missing {
    Real share = 0;                    ///< of the solid
    std::optional<Objection> farthest; ///< of the points that lie in none, beyond rounding
};

/// Of about so many points spread evenly over the link's box; nothing if none of them is inside. Inside a mesh is where
/// lines upwards leave it more often than they enter.
std::optional<Missing> missing_volume(const Link& link, const std::vector<Body>& elements, std::size_t points);

/// Whether inside and outside are beyond doubt: every edge is shared by two triangles that run it in opposite
/// directions, no triangle is there twice, and the connected pieces are wound alike.
bool plain(const std::vector<Corners>& triangles);
/// Whether all meshes of the link are.
bool plain(const Link& link);

} // namespace judge
