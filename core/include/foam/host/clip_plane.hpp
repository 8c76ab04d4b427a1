// Planes that the spheres of a link keep off: a mount, a table.
#pragma once

#include <foam/sphere.hpp>

#include <span>
#include <string>

namespace foam {

/// The plane of all points p with n · p = offset, n the unit vector along `normal`, in a link's frame. Spheres keep off
/// the side that the normal points to: there none reaches farther than `reach` from the plane.
struct ClipPlane {
    Vec3 normal{0, 0, -1}; ///< of any length but zero
    double offset = 0;     ///< m
    double reach = 0;      ///< m; above 0

    bool operator==(const ClipPlane&) const = default;
};

/// What came of a plane.
struct PlaneReach {
    ClipPlane plane;
    double reached = 0; ///< m; by how much spheres reach beyond the plane; negative: they end before it

    bool kept() const { return reached <= plane.reach; }
};

/// By how much a sphere reaches beyond the plane, m; negative: it ends before it.
double reach_beyond(const ClipPlane& plane, const Sphere& sphere);
/// The largest of several; minus infinity of none.
double reach_beyond(const ClipPlane& plane, std::span<const Sphere> spheres);

/// "normal [0, 0, -1], offset 0.01 m".
std::string text_of(const ClipPlane& plane);

/// The same plane as it is seen from another frame; `pose`: of that frame in this one.
ClipPlane seen_from(const ClipPlane& plane, const Pose& pose);

} // namespace foam
