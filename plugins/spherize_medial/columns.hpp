// The solid as columns: parallel lines with the intervals inside it (a ray representation, Van Hook 1986's "dexels").
// Determines within nanoseconds whether a point is inside, and within microseconds the volume of balls outside the
// solid, which is the cost that all searches of this plugin minimise.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace foam::medial {

// A normalised frame for each shape: origin at its middle, axes along its principal directions, size 1. All work of
// this plugin takes place in it, so that a part of 0.1 µm, a part far from the origin and an inclined part are all the
// same.

struct Frame {
    Vec3 origin;              ///< m, link frame
    std::array<Vec3, 3> axes; ///< unit; the last is the direction of least extent
    double scale = 1;         ///< m per unit

    Vec3 to_local(const Vec3& p) const;
    Vec3 to_world(const Vec3& p) const;
    Vec3 direction_to_world(const Vec3& v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
    /// Returns the sphere in the link frame, with its radius rounded up by what the change of coordinates may lose.
    Sphere sphere_to_world(const Sphere& sphere) const;
};

/// Returns the principal axes by the second moments of the surface; the coordinate axes where the moments are
/// undetermined. The largest extent of the surface becomes 1. Throws Error(geometry) if the surface has no extent or is
/// too large to compute with.
Frame principal_frame(const Mesh& surface);

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

/// Returns at most `count` balls inside the solid about some of the centres, each as large as possible. One after
/// another the ball with most points of a lattice that no ball contains yet (greedy maximum coverage; Nemhauser, Wolsey
/// and Fisher 1978: at least 1 - 1/e of the maximum). Local frame. Empty if no centre is inside.
std::vector<Sphere> inner_balls(const Solid& solid, const Frame& frame, const Columns& columns,
                                std::span<const Sphere> centers, std::size_t count, Context& context);

} // namespace foam::medial
