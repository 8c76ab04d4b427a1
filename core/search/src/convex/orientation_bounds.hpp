// Bounds on the volume of elements along any of some orientations.
#pragma once

#include "least_fit.hpp"

#include <array>
#include <vector>

namespace foam::inline search::convex {

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

} // namespace foam::inline search::convex
