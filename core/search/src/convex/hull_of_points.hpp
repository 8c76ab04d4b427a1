// The hull of few points, over and over: its vertices and edges, its volume.
#pragma once

#include <foam/geometry/internal/quickhull.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace foam::inline search::convex {

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
