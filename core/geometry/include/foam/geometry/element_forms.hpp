// Elements in the words and numbers of a file that cannot state them as they are. Whatever comes of an element contains
// it.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/elements.hpp>

#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the element at a pose that hardly differs from its own, as a file states it: its sizes grow by the most that
/// the difference of the rotations moves a point of it. Equal poses change nothing. Precondition: not a hull.
Element stated_at(Element element, const Pose& pose);

/// Returns a cylinder and two spheres whose union contains the capsule, for readers without capsules. The cylinder
/// overlaps the spheres by 1e-5 of the radius, so that a proof finds no seam; its edges lie at most 1e-10 of the radius
/// outside the capsule. Precondition: a capsule.
std::vector<Element> capsule_parts(const Element& capsule);
/// Returns the elements with one capsule for each three in a row that are its parts: a cylinder, and two spheres of its
/// radius at its ends, in any order. Each capsule lies in its parts. Others stay. O(elements).
Elements with_joined_capsules(std::span<const Element> elements);

/// Returns a convex polytope with few vertices that contains the element, for readers that know no such kind, in the
/// link's frame. Round parts are circumscribed with `segments` around a circle, a multiple of 4.
Element enclosing_hull(const Element& element, int segments = 16);

/// Returns a hull that contains the given one, without a rotation and with vertices that single precision holds
/// exactly: most programs read meshes so. Its vertices are those of the given one, moved outwards by about the rounding
/// of their coordinates; a hull of that form stays as it is. The frame is the link's, unless the hull is small and far
/// from it. Precondition: a hull. Throws Error(geometry) if its numbers are too large for single precision.
Element float32_hull(const Element& hull);

/// Returns the hull of a mesh if the mesh is convex: closed, and of the volume of its hull, to 1e-9 of it; else null.
std::shared_ptr<const Polytope> hull_if_convex(const Mesh& mesh);

} // namespace geometry
} // namespace foam
