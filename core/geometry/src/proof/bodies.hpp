// Convex elements for proofs: smaller by more than all rounding errors.
#pragma once

#include "proof/cover.hpp"

#include <foam/geometry/element.hpp>

#include <span>
#include <vector>

namespace foam::inline geometry {

/// Returns a length from `origin` within which all valid elements lie.
double reach_from(const Vec3& origin, std::span<const Element> elements);

/// Elements in coordinates relative to the surface's centre, each eroded by its slack: a point that a body holds, as
/// computed, lies in the element without rounding. docs/dev/certificate.md has the argument. Elements that are not
/// valid, and those too small or too large for the argument, hold nothing.
class Bodies {
public:
    /// `extent`: the largest distance of a vertex from `origin`. `most_halvings`, `caution`: as for Balls.
    Bodies(const Elements& elements, const Vec3& origin, double extent, std::uint32_t most_halvings,
           double caution = 1);

    std::size_t size() const { return bodies_.size(); }
    bool holds_something(std::uint32_t i) const { return bodies_[i].sound; }
    /// Returns the box around body `i`; empty if it holds nothing.
    const Box& bounds(std::uint32_t i) const { return bodies_[i].bounds; }
    bool holds(std::uint32_t i, const Vec3& p) const { return bodies_[i].sound && holds(bodies_[i], p, 0); }
    bool holds(std::uint32_t i, const Piece& piece) const;
    /// Calls take(i) for the bodies that hold the point.
    template <class Take> void holders(const Vec3& p, Take take) const {
        const auto around = [&](const BvhNode& node) { return contains(node, p); };
        for_each_entered(bvh_, around, [&](std::uint32_t place) {
            const std::uint32_t i = of_[bvh_.order()[place]];
            if (holds(i, p)) {
                take(i);
            }
        });
    }
    /// Returns in `result` the bodies whose bounds meet a box, ascending.
    void meeting(const Box& box, std::vector<std::uint32_t>& result) const;
    /// Returns whether a body contains a ball or capsule.
    bool holds(std::uint32_t i, const RoundPart& part) const {
        return bodies_[i].sound && holds(bodies_[i], part.from, part.radius) && holds(bodies_[i], part.to, part.radius);
    }
    /// Returns how far `p` is outside body `i`, negative inside; infinite if the body holds nothing. For a hull it is
    /// the largest distance from a plane, which is no more than the distance.
    double depth(std::uint32_t i, const Vec3& p) const;
    /// Returns a length by which the element has to grow so that the body holds `p`: at least the distance, and no
    /// more than that and some slack; 0 inside.
    double growth(std::uint32_t i, const Vec3& p) const;
    /// Appends to `near` those of near[begin, end) that may be nearest to a point of the piece, or may contain it.
    void choose_near(const Piece& piece, std::size_t begin, std::size_t end, std::vector<std::uint32_t>& near) const;
    struct Gap {
        bool held = false;        ///< one body contains the piece
        double lower = 0;         ///< of the corner that is farthest outside, from the body that comes nearest
        double upper = 0;         ///< with this growth one element contains the piece
        std::size_t farthest = 0; ///< that corner of PiecePoints
    };
    /// Returns bounds of how far a piece is outside of bodies.
    Gap gap(const Piece& piece, std::span<const std::uint32_t> bodies) const;
    const Vec3& center(std::uint32_t i) const { return bodies_[i].center; }
    /// Returns a point in the body's own frame, in which its axes are those of the box, cylinder or ellipsoid.
    Vec3 local(std::uint32_t i, const Vec3& p) const { return local(bodies_[i], p); }
    /// Returns a direction of the body's own frame in that of the surface.
    Vec3 turned(std::uint32_t i, const Vec3& v) const {
        const std::array<Vec3, 3>& rows = bodies_[i].rows;
        return rows[0] * v.x + rows[1] * v.y + rows[2] * v.z;
    }
    /// Returns an axis of the body's own frame in that of the surface.
    const Vec3& axis(std::uint32_t i, int axis) const { return bodies_[i].rows[static_cast<std::size_t>(axis)]; }
    /// Returns a length below which gaps come from rounding: elements that touch leave such a gap.
    double rounding() const { return rounding_; }
    double slack(std::uint32_t i) const { return bodies_[i].slack; }

    /// The planes of a box or a hull; empty for round bodies. normal · (p - center) <= offset for the points p that it
    /// holds.
    std::span<const Polytope::Face> planes(std::uint32_t i) const { return bodies_[i].planes; }

private:
    /// What a body is to the functions for points, which are quick for the first three.
    enum class Form { round_box, cylinder, polytope, other };
    struct Body {
        Form form = Form::round_box;
        bool sound = false;
        std::array<Vec3, 3> rows; ///< of the rotation to the body's frame
        Vec3 center;
        Vec3 half;         ///< of the core, eroded
        double radius = 0; ///< eroded
        double slack = 0;
        Box bounds;
        std::vector<Polytope::Face> faces;  ///< hull: in the body's frame, eroded
        std::vector<double> blocks;         ///< the same, for many at a time: normals' x, y, z and offsets
        std::vector<Polytope::Face> planes; ///< the same, and those of a box, turned to the surface's frame
        std::shared_ptr<const Polytope> hull;
        std::vector<std::uint32_t> face_of; ///< hull: the face that each triangle belongs to
        Vec3 middle;                        ///< hull: origin of the body's frame in that of the hull
        Element rest;                       ///< other forms: the element, eroded
    };

    void add(const Element& element, const Vec3& origin, double extent, double unit, double placement);
    static Form form_of(const Element& element);
    static double reach_of(const Body& body);
    static void set_hull(Body& body, const Element& element);
    static void lower_faces(Body& body);
    static double distance_to_hull(const Body& body, const Vec3& q);
    static void erode(Body& body, const Element& element);
    static Vec3 local(const Body& body, const Vec3& p) {
        const Vec3 v = p - body.center;
        return {dot(body.rows[0], v), dot(body.rows[1], v), dot(body.rows[2], v)};
    }
    static void set_blocks(Body& body);
    static bool below_faces(const Body& body, const Vec3& q, double room);
    /// Returns whether a body holds the ball with `radius` about a point.
    static bool holds(const Body& body, const Vec3& p, double radius);

    std::vector<Body> bodies_;
    double rounding_ = 0;
    Bvh bvh_; ///< over the bounds of those that hold something, by their places in of_
    std::vector<std::uint32_t> of_;
};

} // namespace foam::inline geometry
