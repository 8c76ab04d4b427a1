// Points that elements are to hold, and their hulls.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/internal/quickhull.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace foam::inline search::convex {

/// Least half thickness of an element, as a share of the size: what is flat gets an element all the same.
constexpr double thin = 5e-7;

/// The extreme points of a point set, in units about the origin of the cloud.
struct Cloud {
    std::vector<Vec3> points;  ///< vertices of the hull; all points if they lie in a plane
    std::vector<Vec3> normals; ///< of the hull's faces, large ones first; of flat points that of the plane, or none
    Vec3 origin{};             ///< m
    double unit = 1;           ///< m; the diagonal of the bounds
    bool flat = false;         ///< the points lie in a plane

    Vec3 to_unit(const Vec3& p) const { return (p - origin) / unit; }
};

/// Returns the cloud of at least one finite point. O(n log n).
Cloud cloud_of(std::span<const Vec3> points);
/// Returns the cloud of all the points, not of the extreme ones alone, and some normals of their hull. For quick fits:
/// there is no hull of many points to be made. O(n).
Cloud quick_cloud_of(std::span<const Vec3> points);

/// Returns the points that are farthest along one of 400 directions all around, or all of few points. To the precision
/// of `float`. O(n).
std::vector<Vec3> extremes_of(std::span<const Vec3> points);
/// Returns the same for 64 directions: enough for a quick fit.
std::vector<Vec3> few_extremes_of(std::span<const Vec3> points);

/// An element of any kind but the hull in the frame of a cloud.
struct Fit {
    Element::Kind kind = Element::Kind::box;
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}; ///< of the element: x, y and z
    Vec3 center{};
    Vec3 half{};
    double radius = 0;

    Vec3 local(const Vec3& p) const {
        const Vec3 d = p - center;
        return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)};
    }
    Vec3 outside(const Vec3& p) const { return axes[0] * p.x + axes[1] * p.y + axes[2] * p.z + center; }
};

/// Returns the volume in cubic units.
double volume(const Fit& fit);
/// Returns the element in metres, larger by more than the rounding of its numbers.
Element element_of(const Fit& fit, const Cloud& cloud);
/// Returns an element of any kind but the hull in a frame of this origin and unit (m).
Fit fit_of(const Element& element, const Vec3& origin, double unit);
/// Returns a right-handed frame with the z axis along a unit vector.
std::array<Vec3, 3> frame_along(const Vec3& z);
/// Returns axes turned by a small rotation vector, in the frame of the axes; orthonormal.
std::array<Vec3, 3> turned(const std::array<Vec3, 3>& axes, const Vec3& by);

/// A hull of a problem whose size is about 1.
class HullOfPoints {
public:
    /// Makes the hull to about 1e-10. Returns false for points that lie in a plane.
    bool run(std::span<const Vec3> points);
    /// Makes the hull to about the tolerance: points that are not farther outside of it do not become vertices.
    bool run(std::span<const Vec3> points, double tolerance);
    /// Indices of the points that are vertices, ascending; all for points that lie in a plane.
    std::vector<std::uint32_t> vertices() const;
    /// Edges between indices of points; none for points that lie in a plane.
    std::vector<std::array<std::uint32_t, 2>> edges() const;

    const std::vector<geometry::HullTriangle>& triangles() const { return triangles_; }

private:
    std::vector<geometry::HullTriangle> triangles_;
    std::size_t count_ = 0;
};

/// Returns the volume of the hull to about 1e-6. It is quicker than HullOfPoints where many points lie in a plane:
/// these are moved by about that much, so that no exact arithmetic is needed to tell on which side they are.
double volume_of_hull(std::span<const Vec3> points);
/// Returns the sum of the volumes of the hulls of a and of b, to about 1e-6, if it is less than `limit`. Returns what
/// is known to be in them as soon as that is `limit` or more.
double volume_of_hulls(std::span<const Vec3> a, std::span<const Vec3> b, double limit);

} // namespace foam::inline search::convex
