// A part of a file: where it is placed, and its colour.
#pragma once

#include "builder.hpp"

#include <foam/base/hypot.hpp>
#include <foam/geometry/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>

namespace foam::load_mesh {

/// The map p ↦ A p + t in double precision, so that the products of deep node trees keep their digits. `rows`: of A.
struct Affine {
    std::array<Vec3, 3> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;

    Vec3 turn(const Vec3& v) const { return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)}; }
    Vec3 operator*(const Vec3& p) const { return turn(p) + shift; }
    Affine operator*(const Affine& other) const {
        Affine result;
        for (int column = 0; column < 3; ++column) {
            const Vec3 image = turn({other.rows[0][column], other.rows[1][column], other.rows[2][column]});
            for (int row = 0; row < 3; ++row) {
                result.rows[static_cast<std::size_t>(row)][column] = image[row];
            }
        }
        result.shift = *this * other.shift;
        return result;
    }
    /// Returns whether the map changes handedness.
    bool mirrors() const { return dot(rows[0], cross(rows[1], rows[2])) < 0; }

    static Affine translation(const Vec3& t) { return {Affine{}.rows, t}; }
    static Affine scaling(const Vec3& s) { return {{Vec3{s.x, 0, 0}, Vec3{0, s.y, 0}, Vec3{0, 0, s.z}}, {}}; }
    static Affine rotation(const Pose& pose) { return {pose.rotation, {}}; }
    /// Returns the rotation by a quaternion of any length; nothing if it is not a rotation.
    static std::optional<Affine> rotation(double x, double y, double z, double w) {
        const double length = foam::hypot(foam::hypot(x, y), foam::hypot(z, w));
        if (!(length > 0) || !std::isfinite(length)) {
            return std::nullopt;
        }
        x /= length, y /= length, z /= length, w /= length;
        return Affine{{Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                       Vec3{2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                       Vec3{2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}},
                      {}};
    }
};

/// Returns 0xRRGGBBAA of shares from 0 to 1; others are moved there. A colour that cannot be seen is 0: none.
inline std::uint32_t colour_number(const std::array<double, 4>& shares) {
    std::uint32_t colour = 0;
    for (const double share : shares) {
        const double inside = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0;
        colour = colour << 8 | static_cast<std::uint32_t>(std::lround(255 * inside));
    }
    return (colour & 0xFFU) == 0 ? 0 : colour;
}

/// Polygons with points in the frame of the part. Points that no face uses need not be finite.
struct Part {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;   ///< one polygon after the other; in range
    std::vector<std::uint32_t> sizes;     ///< corners of each polygon, at least 3
    std::vector<std::uint32_t> materials; ///< of each polygon, numbers for its reader; empty: all have 0
    /// Returns the error `what` about point i, with its place in the file.
    std::function<Error(std::size_t i, const std::string& what)> error;
};

/// Returns the part without the points that no face uses, so that the time to place it depends on its faces only.
/// Errors keep the file's numbers of the points.
Part compacted(Part part);

/// Adds the polygons at `pose`, reversed where it mirrors, so that the outside stays outside. `colours`: of the
/// materials, 0xRRGGBBAA; 0, and those that it does not have: none. Throws part.error() for a used point that is not
/// finite.
void place(const Part& part, const Affine& pose, MeshBuilder& builder, std::span<const std::uint32_t> colours = {});

} // namespace foam::load_mesh
