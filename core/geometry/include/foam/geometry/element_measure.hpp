// Proof, growth and figures of any convex elements: what measure.hpp has for spheres. Elements that are all spheres
// take the functions for spheres, and have their results to the bit.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/sphere.hpp>

#include <vector>

#include <utility>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Proves that every triangle of solid.surface() lies in the union of the elements. An element that contains the
/// corners of a convex piece contains the piece; otherwise the piece is cut along the faces of an element, or halved.
/// Rounding is on the safe side: an uncovered point never passes. `depth` as in certify() for spheres.
Certificate certify(const Solid& solid, const ElementsView& elements, int depth = 40);
/// Returns whether certify() holds. Where it does not, this takes much less time: the gap is not searched for.
bool covers(const Solid& solid, const ElementsView& elements);

/// Measures the figures. `Measures::spheres` counts all elements. Volumes are integrated along lines, exactly along
/// each line, where elements are not all spheres. Elements that are not valid count as absent.
Measures measure(const Solid& solid, const ElementsView& elements, const MeasureOptions& options = {});

/// Returns the elements grown by about the least that makes certify() hold; none becomes smaller. Elements that cover
/// already stay as they are. Throws Error(geometry) if no element is valid.
Approximation::Level grown_to_cover(const Solid& solid, Approximation::Level elements);

/// Returns the volume of the union, m³, integrated along the same lines for equal bounds: relative error about 1e-3.
double union_volume(const ElementsView& elements);
/// Returns vol(S \ U), m³, along the solid's lines, as Solid::missing_volume() does for spheres.
double missing_volume(const Solid& solid, const ElementsView& elements);
/// Returns vol(U \ S), m³, along lines that are the same for all elements of a solid: the lines do not
/// depend on the elements, so results for one solid can be compared.
double excess_volume(const Solid& solid, const ElementsView& elements);
/// Returns excess_volume() and missing_volume(), in the time of the first alone.
std::pair<double, double> excess_and_missing_volume(const Solid& solid, const ElementsView& elements);

} // namespace geometry
} // namespace foam
