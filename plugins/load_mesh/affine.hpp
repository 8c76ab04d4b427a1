// Affine maps of scene nodes.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>
#include <cmath>
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
        const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
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

} // namespace foam::load_mesh
