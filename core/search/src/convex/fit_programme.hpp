// A fit as the variables of a programme: the volume is to fall, and points are to stay inside.
#pragma once

#include "cloud.hpp"
#include "quadratic_step.hpp"

namespace foam::inline search::convex {

// The variables: a rotation vector (3, in the frame of the fit), centre (3, in that frame), half lengths (3), radius.
// Where a kind does not use one, its slopes are 0.

/// Returns whether a fit of the kind has a length along an axis of its own.
bool uses_half(Element::Kind kind, int axis);
/// Returns the vector from the nearest point of the core of a fit, in the frame of the fit.
Vec3 from_core(const Fit& fit, const Vec3& local);
/// Makes the lengths of a fit the least that hold the points, about its core: its radius, the half length of a cylinder
/// and those of a box.
void close_around(Fit& fit, const Cloud& cloud);
/// Returns the points within a distance of the boundary of a fit that holds all, in its frame: what a small change of
/// the fit depends on.
Cloud near_boundary(const Fit& fit, const Cloud& cloud, double distance);
/// Writes the constraints of lengths, and of points that a step may reach, to first order. `length`: at most that of
/// the variables of the step. `keep_axes`: a step does not turn the fit.
void set_constraints(const Fit& fit, const Cloud& cloud, double length, std::vector<Constraint>& constraints,
                     bool keep_axes);
/// Returns the fit after a step, with the lengths that hold the points.
Fit stepped(const Fit& fit, const Variables& step, const Cloud& cloud);

/// Returns the volume's slopes. Not for boxes and spheres.
Variables volume_slopes(const Fit& fit);

} // namespace foam::inline search::convex
