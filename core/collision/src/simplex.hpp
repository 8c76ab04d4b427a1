// The point of a simplex of up to four corners that is closest to the origin.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>
#include <cstddef>

namespace foam::inline collision {

/// A simplex in the Minkowski difference of two bodies. Each corner is a point of the first body minus one of the
/// second.
struct Simplex {
    struct Corner {
        Vec3 point, in_first;
    };
    std::array<Corner, 4> corners{};
    std::array<double, 4> weights{}; ///< of the closest point
    std::size_t size = 0;

    void add(const Corner& corner) { corners[size++] = corner; }
    /// Reduces the simplex to the corners that span the point closest to the origin, and returns that point; all four
    /// corners remain if the origin lies inside.
    Vec3 closest();
    /// Returns the point of the first body at the closest point.
    Vec3 in_first() const;
};

} // namespace foam::inline collision
