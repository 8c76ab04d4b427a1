// Whether the geometry of two links touches, as it is: triangles against triangles.
#pragma once

#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <memory>
#include <vector>

namespace foam::inline collision {

/// The geometry of a link: its meshes, and polyhedra within its primitives. So whatever touches is in contact for
/// certain, and round primitives are in contact a little earlier.
class ContactShape {
public:
    explicit ContactShape(std::shared_ptr<const Solid> solid);

    /// Contains all of it, in the link's frame.
    const Sphere& bound() const { return bound_; }
    /// Returns whether a triangle of one passes through a triangle of the other, or a piece of one lies in the other.
    /// `pose`: from the other's frame to this one's. O(m log n) for m triangles near the other.
    bool touches(const ContactShape& other, const Pose& pose) const;

private:
    bool crosses(const ContactShape& other, const Pose& pose) const;
    /// Returns whether a connected piece of the other lies inside.
    bool holds_piece_of(const ContactShape& other, const Pose& pose) const;
    TriangleCorners corners(std::uint32_t triangle) const;

    std::shared_ptr<const Solid> solid_;
    Mesh mesh_;
    std::vector<Box> boxes_; ///< of the triangles
    Bvh bvh_;
    std::vector<Vec3> of_pieces_; ///< a vertex of each connected piece
    Sphere bound_;
};

} // namespace foam::inline collision
