// The geometry of a link, as the pairs are compared: balls in groups, and shapes that touch.
#pragma once

#include <foam/collision/self_collision.hpp>
#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace foam::inline collision::self_collision {

/// An element that is no sphere, with a sphere around it.
struct BoundedElement {
    Element element;
    Sphere bound;
};

struct BallGroup {
    Sphere bound;
    std::vector<Sphere> spheres;
    std::vector<BoundedElement> shaped; ///< elements that are no spheres

    /// Precondition: there is at least one element.
    explicit BallGroup(const Elements& elements) : spheres(elements.spheres()) {
        std::vector<Sphere> all = spheres;
        for (const Element& element : elements.shaped()) {
            shaped.push_back({element, minimum_enclosing_sphere(enclosing_mesh(element).vertices)});
            all.push_back(shaped.back().bound);
        }
        bound = enclosing_sphere(all);
    }
};

/// Returns the distance between the surfaces, m; negative where the spheres overlap.
inline double gap(const Sphere& a, const Sphere& b) {
    return distance(a.center, b.center) - a.radius - b.radius;
}

/// Returns whether the balls have a common point.
inline bool touch(const Sphere& a, const Sphere& b) {
    const double reach = a.radius + b.radius;
    return squared_norm(a.center - b.center) <= reach * reach;
}

inline Sphere moved(const Pose& pose, const Sphere& sphere) {
    return {pose * sphere.center, sphere.radius};
}

/// Returns whether elements of two links touch. O(n · m) in the elements near the other link.
bool touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b);
/// Returns the same of those pairs of elements of which at least one is no sphere.
bool shaped_touch(const BallGroup& a, const Pose& pose_a, const BallGroup& b, const Pose& pose_b);

} // namespace foam::inline collision::self_collision

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

/// The shape of each link, made when it is first needed: links that never come near another have none. Thread-safe.
class LinkShapes {
public:
    explicit LinkShapes(const LinkSolids& solids);

    /// Returns whether the geometry of the link is known.
    bool has(std::size_t link) const { return link < solids_.size() && solids_[link]; }
    std::vector<bool> have_geometry() const;
    /// Returns whether the geometry of two links touches. `poses`: of all links. False where it is not known.
    bool touching(std::size_t first, std::size_t second, std::span<const Pose> poses) const;

private:
    using BallGroup = self_collision::BallGroup;
    struct Shape {
        Sphere around;                      ///< contains the geometry
        std::optional<BallGroup> primitives; ///< all of the geometry, where there is no mesh
        std::once_flag made;
        std::unique_ptr<ContactShape> mesh; ///< once it is made
    };
    const ContactShape& mesh(std::size_t link) const;

    const LinkSolids& solids_;
    mutable std::vector<Shape> shapes_;
};

/// The shapes in one configuration; `touching` as PlacedLinks has it.
class PlacedShapes {
public:
    PlacedShapes(const Kinematics& kinematics, const LinkShapes& shapes)
        : kinematics_(kinematics), shapes_(shapes), poses_(kinematics.robot().links.size()) {}

    void place(std::span<const double> configuration) { kinematics_.link_poses(configuration, poses_); }
    bool touching(std::size_t first, std::size_t second) const { return shapes_.touching(first, second, poses_); }

private:
    const Kinematics& kinematics_;
    const LinkShapes& shapes_;
    std::vector<Pose> poses_;
};

/// Returns the pairs of links with geometry that are not adjacent, in the order of the links.
LinkPairs pairs_apart(const Kinematics& kinematics, const LinkShapes& shapes);

/// Returns those of the pairs whose geometry touches in every one of the configurations. Pairs that are apart in one are
/// not tested in the next.
LinkPairs touching_in_all(const Kinematics& kinematics, const LinkShapes& shapes, LinkPairs pairs,
                          const std::vector<std::vector<double>>& configurations);

} // namespace foam::inline collision
