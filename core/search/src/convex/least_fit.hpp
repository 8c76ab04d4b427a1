// The least element of a kind around a cloud.
#pragma once

#include "cloud.hpp"

#include <foam/search/spherize.hpp>

namespace foam::inline search::convex {

/// Returns the box along the axes around the points.
Fit box_along(const Cloud& cloud, const std::array<Vec3, 3>& axes);
/// Returns the least of the boxes along the principal axes, and with one of these axes.
Fit quick_box(const Cloud& cloud);
/// Returns a box of little volume: from several starts, each axis in turn is kept and the least rectangle about it
/// taken until no axis gives less.
Fit least_box(const Cloud& cloud, Effort effort);
/// Returns the cylinder of least volume along a direction.
Fit cylinder_along(const Cloud& cloud, const Vec3& direction);
Fit least_cylinder(const Cloud& cloud, Effort effort);
/// Returns the capsule along a direction whose side is the smallest circle around the points' projection.
Fit capsule_along(const Cloud& cloud, const Vec3& direction);
Fit least_capsule(const Cloud& cloud, Effort effort);
/// Returns a swept box of no more volume than the box and the capsule above.
Fit least_swept_box(const Cloud& cloud, Effort effort);
Fit least_sphere(const Cloud& cloud);
/// Returns an element along the principal axes of the points, or along those turned to the least rectangles about them.
/// Its volume is mostly within some per cent of the least. `axis_aligned`: boxes have the axes of the points' frame.
/// O(n log n).
Fit quick_fit(Element::Kind kind, const Cloud& cloud, bool axis_aligned = false);
/// Returns one of these. Precondition: the kind is not hull.
Fit least_fit(Element::Kind kind, const Cloud& cloud, Effort effort, bool axis_aligned = false);

/// Returns the fit, changed by steps that reduce its volume while it holds all points, until there are none: each step
/// solves the problem with the constraints made linear (a sequence of quadratic programmes). `first_reach`: length of
/// the first step, units. `keep_axes`: only moves and lengths change. Not for boxes and spheres.
Fit descended(const Fit& fit, const Cloud& cloud, int most_steps, double first_reach = 0.1, bool keep_axes = false);

} // namespace foam::inline search::convex
