// Half-space constraints: planes beyond which the spheres of a link may extend only so far, such as a mount or a table.
#pragma once

#include <foam/geometry/sphere.hpp>

#include <span>
#include <string>

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
/// Returns the maximum over several spheres; minus infinity for none.
double reach_beyond(const ClipPlane& plane, std::span<const Sphere> spheres);

/// Returns "normal [0, 0, -1], offset 0.01 m".
std::string text_of(const ClipPlane& plane);

/// Returns the same plane in another frame; `pose`: of that frame in this one.
ClipPlane seen_from(const ClipPlane& plane, const Pose& pose);

} // namespace geometry
} // namespace foam
