// The least element of a kind around a cloud, bounds of it, and several that share a body.
#pragma once

#include "cells.hpp"
#include "cloud.hpp"
#include "by_spheres/measured/occupancy.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/search/cover.hpp>
#include <foam/search/spherize.hpp>

#include <array>
#include <vector>

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

/// Orientations about one in the middle. Of a box: Rodrigues vectors in a cube, of which the cube within tan(π/8) has
/// all orientations of a box. Of an axis: points on one of three faces of a cube, by central projection; all directions
/// but for their sign. Both projections are gnomonic, so the farthest orientation from the middle is at a corner.
struct Orientations {
    Vec3 at{};
    double half = 0;
    int face = 0; ///< of an axis
    double lower_bound = 0;

    bool operator<(const Orientations& o) const { return lower_bound > o.lower_bound; } // least first
};

/// Returns cells that together have all orientations.
std::vector<Orientations> all_orientations(bool of_axis);
/// Returns the parts of a cell, halved along each of its axes.
std::vector<Orientations> parts_of(const Orientations& cell, bool of_axis);
/// Returns the axes of a box turned by a Rodrigues vector.
std::array<Vec3, 3> axes_at(const Vec3& r);
/// Returns the direction in the middle of a cell of axes.
Vec3 direction_at(const Orientations& cell);
/// Returns the largest angle between the middle orientation of a cell and another one in it.
double reach(const Orientations& cell, bool of_axis);

/// Each returns a volume that no element around the points has less of, units³: a box whose axes are those turned by at
/// most the angle, and a cylinder or capsule along a direction within the angle, which is at most a right one.
double bound_of_box(const Cloud& cloud, const std::array<Vec3, 3>& axes, double angle);
/// `here`: the least cylinder along the middle direction.
double bound_of_cylinder(const Cloud& cloud, const Fit& here, double angle);
/// `here`: the volume of the least capsule along the middle direction.
double bound_of_capsule(double here, double angle);

/// Returns the element of the kind around the cloud that protrudes least, in the mean or at most, of those found by
/// descents from elements of little volume. All of the solid's surface must be in the hull of the cloud. Precondition:
/// the kind is neither hull nor sphere.
Fit least_protrusion(Element::Kind kind, const Cloud& cloud, const Solid& solid, Objective objective,
                     Effort effort, bool axis_aligned);

/// Makes the volume of the union outside the solid less, while the union goes on to hold the surface. In turn each
/// element gives up what others hold: it moves, turns and changes its lengths by steps that reduce its own share of the
/// volume outside, with the points that no other element holds as constraints. The slopes of that share are integrals
/// over the part of the element's boundary that lies outside the solid and the others, and the steps those of a
/// sequence of quadratic programmes. Elements that hold nothing alone are dropped. Precondition: no hulls; the fits in
/// the frame of the body hold its surface.
std::vector<Fit> descended_together(const Body& body, const by_spheres::Occupancy& occupancy, std::vector<Fit> fits,
                                    Effort effort, bool keep_axes);

/// Returns a hull around points that need not span space, larger by a billionth of their size and, where it would be
/// thinner, a millionth thick. At most `most_vertices` vertices, where that is more than 3.
Element hull_around(std::vector<Vec3> points, double unit, std::size_t most_vertices);

/// Returns the elements, grown where the proof asks for it, with their proof; their volume is left to the caller.
Cover proved(const Solid& solid, Elements elements);

/// Returns the figure that the objective compares: m³ of excess volume, or m of protrusion.
double figure_of(const Solid& solid, const Cover& cover, Objective objective);

} // namespace foam::inline search::convex
