// Points on the surface of an element.
#pragma once

#include <foam/geometry/element.hpp>

#include <vector>

namespace foam::inline geometry {

/// A point of an element's surface, in the link's frame, that stands for `area` of it, m²; 0: only a place to look at.
struct ElementPoint {
    Vec3 point;
    Vec3 normal; ///< unit, outwards
    double area;
};

/// Returns about `count` points spread over the surface by area, at least one in each face, and the corners of boxes
/// and hulls. The areas add up to that of the surface.
std::vector<ElementPoint> surface_points(const Element& element, std::size_t count);

} // namespace foam::geometry
