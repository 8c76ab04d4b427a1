// Elements enlarged to contain points.
#pragma once

#include <foam/geometry/element.hpp>

#include <span>

namespace foam::inline geometry {

/// Returns an element of the same kind that contains the element, and everything within `room` of the points, with
/// little added volume: boxes and cylinders reach farther on one side, capsules and swept boxes become thicker or
/// longer, whichever adds less. A hull gets no more vertices, unless it is too thin for that: points become
/// vertices where others vanish, else faces move outwards.
Element enlarged(const Element& element, std::span<const Vec3> points, double room);

/// Returns about the volume that enlarged() adds for the points.
double added_volume(const Element& element, std::span<const Vec3> points);

} // namespace foam::geometry
