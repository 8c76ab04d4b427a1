// The solid as columns: parallel lines with the intervals inside it (a ray representation, Van Hook 1986's "dexels").
// Determines within nanoseconds whether a point is inside, and within microseconds the volume of balls outside the
// solid, which is the cost that all searches of this plugin minimise.
#pragma once

#include "frame.hpp"

#include <foam/geometry/solid.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam::medial {

/// A part of a column, along the third axis of the local frame.
struct Segment {
    double low, high;
};

class Columns {
public:
    /// Makes about `count` columns along the least extent, over the bounding rectangle. Exact along a column for a
    /// closed solid, sampled where the winding number decides what is inside.
    Columns(const Shape& shape, const Frame& frame, std::size_t count);

    bool inside(const Vec3& p) const;
    /// Returns the distance between columns.
    double step() const { return step_; }
    /// Returns vol(S).
    double volume() const { return volume_; }
    /// Returns vol(U \ S) for the union U of the balls.
    double outside(std::span<const Sphere> balls) const;

    /// The union of the solid and some balls in the neighbourhood of one ball, where that ball has no cost.
    class Free {
    public:
        /// Prepares the cube of half edge `reach` about `center`.
        Free(const Columns& columns, std::span<const Sphere> others, const Vec3& center, double reach);
        /// Returns the volume of the ball outside this union; infinite if the ball leaves the cube.
        double outside(const Sphere& ball) const;

    private:
        const Columns& columns_;
        Vec3 center_;
        double reach_;
        long x_low_, x_high_, y_low_, y_high_; ///< columns, the upper ones included
        std::vector<std::uint32_t> offsets_;
        std::vector<Segment> segments_;
    };

private:
    friend class Free;
    std::span<const Segment> at(long x, long y) const;
    long column_x(double x) const { return static_cast<long>(std::floor((x - low_x_) / step_)); }
    long column_y(double y) const { return static_cast<long>(std::floor((y - low_y_) / step_)); }
    double center_x(long i) const { return low_x_ + (static_cast<double>(i) + 0.5) * step_; }
    double center_y(long i) const { return low_y_ + (static_cast<double>(i) + 0.5) * step_; }

    double low_x_ = 0, low_y_ = 0, step_ = 1, volume_ = 0;
    long nx_ = 0, ny_ = 0;
    std::vector<std::uint32_t> offsets_;
    std::vector<Segment> segments_;
};

} // namespace foam::medial
