// Affine maps in double precision; those of assimp are in single precision.
#pragma once

#include <foam/geometry/vector.hpp>

#include <assimp/matrix4x4.h>

namespace foam::load_assimp {

/// The map p ↦ x p.x + y p.y + z p.z + shift.
struct Affine {
    Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, shift{};

    Vec3 direction(const Vec3& d) const { return x * d.x + y * d.y + z * d.z; }
    Vec3 operator()(const Vec3& p) const { return direction(p) + shift; }
    /// Returns the composition that applies `first` first.
    Affine operator*(const Affine& first) const {
        return {direction(first.x), direction(first.y), direction(first.z), (*this)(first.shift)};
    }
    bool mirrors() const { return dot(x, cross(y, z)) < 0; }

    static Affine scale(double s) { return {{s, 0, 0}, {0, s, 0}, {0, 0, s}, {}}; }
    static Affine from(const aiMatrix4x4& m) {
        return {{m.a1, m.b1, m.c1}, {m.a2, m.b2, m.c2}, {m.a3, m.b3, m.c3}, {m.a4, m.b4, m.c4}};
    }
};

} // namespace foam::load_assimp
