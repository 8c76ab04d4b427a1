// Points on the surface of an element.
#pragma once

#include <foam/geometry/element.hpp>

#include <functional>
#include <vector>

namespace foam::inline geometry {

/// A point of an element's surface that stands for `area` of it, m²; 0: only a place to look at.
struct ElementPoint {
    Vec3 point;
    Vec3 normal; ///< unit, outwards
    double area;
};

/// Returns about `count` points spread over the surface by area, at least one in each face, and the corners of boxes
/// and hulls, in the link's frame. The areas add up to that of the surface, about that of an ellipsoid.
std::vector<ElementPoint> surface_points(const Element& element, std::size_t count);

/// A part of a surface: points for two numbers between 0 and 1, uniform by area.
struct Patch {
    double area;
    std::function<ElementPoint(double, double)> at;
};

/// Returns the area of the patches and `rest`.
double area_of(const std::vector<Patch>& patches, double rest = 0);
/// Returns a patch's share of `count` points, at least one.
std::size_t share_of(std::size_t count, double area, double whole);
/// Appends about `count` points of patches that make up an area: those of a lattice by the golden ratio.
void add_points(const std::vector<Patch>& patches, double area, std::size_t count, std::vector<ElementPoint>& points);

} // namespace foam::inline geometry
