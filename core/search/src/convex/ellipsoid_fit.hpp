// Fits that are ellipsoids.
#pragma once

#include "cloud.hpp"

namespace foam::inline search::convex {

/// Returns how many times larger about its centre an ellipsoid must be to reach a point of its own frame.
double reach_of_ellipsoid(const Fit& fit, const Vec3& local);
/// Returns the unit normal of the larger ellipsoid at that point; `slope`: how much the reach grows along it, 1/unit.
Vec3 normal_of_ellipsoid(const Fit& fit, const Vec3& local, double& slope);
/// Returns about the area of the surface, units² (Thomsen's formula, to a per cent).
double area_of_ellipsoid(const Fit& fit);
/// Returns the ellipsoid of least volume around the points, to within `accuracy` of it, by the weights of points that
/// span it (Khachiyan 1996; with the steps of Todd and Yıldırım, On Khachiyan's algorithm for the computation of
/// minimum-volume enclosing ellipsoids, 2007). O(n) for each of at most `most_steps` steps.
Fit least_ellipsoid(const Cloud& cloud, double accuracy, int most_steps);

} // namespace foam::inline search::convex
