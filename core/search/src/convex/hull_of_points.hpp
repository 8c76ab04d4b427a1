// The hull of few points, over and over: its volume, its vertices and edges.
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
    /// Makes the hull to about 1e-10, and returns its volume; 0 for points that lie in a plane.
    double run(std::span<const Vec3> points);
    /// Makes the hull to about the tolerance: points that are not farther outside of it do not become vertices.
    double run(std::span<const Vec3> points, double tolerance);
    /// Makes the hull to about 1e-6. It is quicker where many points lie in a plane: these are moved by about that
    /// much, so that no exact arithmetic is needed to tell on which side they are.
    double run_quickly(std::span<const Vec3> points);
    /// Indices of the points that are vertices, ascending; all for points that lie in a plane.
    std::vector<std::uint32_t> vertices() const;
    /// Edges between indices of points; none for points that lie in a plane.
    std::vector<std::array<std::uint32_t, 2>> edges() const;

    const std::vector<geometry::HullTriangle>& triangles() const { return triangles_; }

private:
    std::vector<Vec3> moved_;
    std::vector<geometry::HullTriangle> triangles_;
    std::size_t count_ = 0;
};

} // namespace foam::inline search::convex
