// The part of the input that a vertex of the voxel surface can be projected to.
#pragma once

#include "octree.hpp"
#include "triangle.hpp"
#include "voxel_surface.hpp"

#include <limits>

namespace foam::repair {

/// The point of the input nearest to a vertex.
struct Foot {
    Vec3 point;
    double distance = std::numeric_limits<double>::infinity();
};

/// For every vertex the triangles of the input in the solid cells around it: its own cells and those joined to them
/// across faces, among the eight cells at the vertex. Triangles behind a pinch do not count.
class Nearby {
public:
    Nearby(const Mesh& input, const VoxelSurface& surface, const Octree& octree);

    bool none(std::uint32_t vertex) const { return lists_[vertex].empty(); }
    /// Returns the closest point on the triangles near `vertex`. Precondition: there are some.
    Foot closest(std::uint32_t vertex, const Vec3& p) const;
    /// Returns whether the segment passes through a triangle near `vertex`.
    bool is_crossed(std::uint32_t vertex, const Vec3& a, const Vec3& b) const;

private:
    /// A triangle and its bounding ball, to skip distant triangles.
    struct Item {
        Corners corners;
        Vec3 center;
        double radius;
    };

    void collect(std::uint32_t vertex, const VoxelSurface& surface, const Octree& octree);

    std::vector<Item> items_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

} // namespace foam::repair
