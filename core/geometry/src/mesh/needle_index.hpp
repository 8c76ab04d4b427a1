// A hierarchy for meshes of long needles at an angle to the axes.
#pragma once

#include "solid/part_index.hpp"

#include <foam/geometry/internal/triangles.hpp>

#include <span>

namespace foam::inline geometry {

/// Finds triangles by boxes in a frame along the longest edge. The axis-aligned box of a needle from corner to corner
/// of a mesh is that of the mesh: with such boxes each query would visit all needles.
class NeedleIndex {
public:
    /// Returns whether the triangles' axis-aligned boxes overlap so much that this index is faster. `all`: the box
    /// around them.
    static bool pays(std::span<const Box> boxes, const Box& all);

    /// `center`: of the triangles' box. O(n log n).
    NeedleIndex(std::span<const Corners> triangles, const Vec3& center);

    /// Calls visit(i) for the triangles that may be as near to the point as nearest(), m, the near ones first.
    template <class Least, class Visit> void for_each_nearer(const Vec3& p, Least nearest, Visit visit) const {
        index_.for_each_nearer(turned(p - center_), nearest, visit);
    }

    /// Calls visit(i) for the triangles whose boxes the line meets.
    template <class Visit> void for_each_along(const Line& line, Visit visit) const {
        index_.for_each_along(Line(turned(line.origin() - center_), turned(line.direction())), visit);
    }

private:
    Vec3 turned(const Vec3& v) const { return {dot(axes_[0], v), dot(axes_[1], v), dot(axes_[2], v)}; }

    Vec3 center_;
    std::array<Vec3, 3> axes_; ///< orthonormal
    PartIndex index_;
};

} // namespace foam::geometry
