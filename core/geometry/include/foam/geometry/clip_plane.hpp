// Half-space constraints: planes beyond which the spheres of a link may extend only so far, such as a mount or a table.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <span>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A half-space constraint: the plane of all points p with n · p = offset, n the unit vector along `normal`, in a
/// link's frame. Beyond it, on the side to which the normal points, spheres extend by at most `reach`.
struct ClipPlane {
    Vec3 normal{0, 0, -1}; ///< of any length but zero
    double offset = 0;     ///< m
    double reach = 0;      ///< m; above 0

    bool operator==(const ClipPlane&) const = default;
};

/// The result of a half-space constraint.
struct PlaneReach {
    ClipPlane plane;
    double reached = 0; ///< m; how far spheres extend beyond the plane; negative: they end before it

    bool kept() const { return reached <= plane.reach; }
};

/// Returns how far a sphere extends beyond the plane, m; negative: it ends before it.
double reach_beyond(const ClipPlane& plane, const Sphere& sphere);
/// Returns the maximum over all elements; minus infinity for none.
double reach_beyond(const ClipPlane& plane, const Elements& elements);

/// Returns "normal [0, 0, -1], offset 0.01 m".
std::string text_of(const ClipPlane& plane);

/// Returns the same plane in another frame; `pose`: of that frame in this one.
ClipPlane seen_from(const ClipPlane& plane, const Pose& pose);

/// Throws Error(geometry) if the solid itself extends as far beyond a plane as spheres may. `pose`: of the solid's
/// frame in that of the planes.
void require_within(const Solid& solid, const Pose& pose, const std::vector<ClipPlane>& planes);

/// Returns the largest length by which spheres extend farther than the half-space constraints allow, m. Negative: all
/// constraints are kept.
double violation_of(const std::vector<ClipPlane>& planes, const Elements& elements);

/// Returns for each plane how far the spheres extend beyond it.
std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, const Elements& elements);

/// Returns a sentence for each half-space constraint, counted from 1, that is not kept.
std::vector<std::string> not_kept(const std::vector<PlaneReach>& planes);

} // namespace geometry
} // namespace foam
