// What foam asks of a kind of convex element.
#pragma once

#include "convex/convex_line.hpp"
#include "convex/element_surface.hpp"

#include <foam/geometry/element.hpp>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace foam::inline geometry {

/// A kind of element: one object for each, in the file of its core; kinds.cpp lists them. Points and directions are in
/// the element's own frame, unless a function says otherwise.
class ConvexKind {
public:
    constexpr ConvexKind(const char* word, std::span<const std::string_view> numbers)
        : word_(word), numbers_(numbers) {}

    const char* word() const { return word_; }
    /// Returns the names of its numbers, see number_names().
    std::span<const std::string_view> numbers() const { return numbers_; }
    bool has(std::string_view number) const;

    /// Returns the distance outside, and minus the largest slack inside.
    virtual double signed_distance(const Element& e, const Vec3& p) const = 0;
    virtual Vec3 support(const Element& e, const Vec3& direction) const = 0;
    /// Returns the tight box in the link's frame.
    virtual Box bounds(const Element& e) const = 0;
    virtual double volume(const Element& e) const = 0;
    /// Returns the integrals of x², y² and z², m⁵; nothing for a kind whose mesh stands for it.
    virtual std::optional<Vec3> second_moments(const Element&) const { return {}; }
    virtual MaybePart inside_along(const Element& e, const Vec3& origin, const Vec3& direction) const = 0;
    /// Returns a closed mesh that contains the element, `segments` around a circle.
    virtual Mesh mesh(const Element& e, int segments) const = 0;
    /// Returns whether the surface is made of planes, so that the mesh is the element.
    virtual bool has_flat_faces() const { return false; }
    /// Returns whether Balls::find_beneath() knows the surface beneath the facets of the mesh. Proofs of a primitive of
    /// any other kind are about its mesh.
    virtual bool has_known_surface() const { return false; }
    /// Returns whether a radius widens its core in all directions.
    virtual bool is_widened() const { return false; }
    virtual std::vector<ElementPoint> surface_points(const Element& e, std::size_t count) const = 0;

    /// Returns an element that contains everything within `length`. sum(number, length) adds to a number.
    virtual Element grown(Element e, double length, double (*sum)(double, double)) const = 0;
    /// Returns an element that contains the element and all within `room` of points, which are in the link's frame.
    virtual Element enlarged(const Element& e, std::span<const Vec3> points, double room) const = 0;
    /// Returns about the volume that enlarged() adds.
    virtual double added_volume(const Element& e, std::span<const Vec3> points) const;

    // For proofs. The functions for points only divide, multiply and add a few times, and take one root: their rounding
    // is that of a distance. Bodies has quicker ones for boxes with a radius, cylinders and hulls.
    /// Makes the element so much smaller that it holds everything within `length` of what is left. Returns false if
    /// nothing is left.
    virtual bool erode(Element& e, double length) const;
    /// Returns whether the element holds the ball with `radius` about a point; false proves nothing.
    virtual bool holds_ball(const Element& e, const Vec3& p, double radius) const;

protected:
    ~ConvexKind() = default;

private:
    const char* word_;
    std::span<const std::string_view> numbers_;
};

const ConvexKind& kind_of(const Element& element);

/// Returns an element of the same kind that contains the element, and everything within `room` of the points, with
/// little added volume: boxes and cylinders reach farther on one side, capsules and swept boxes become thicker or
/// longer, whichever adds less; an ellipsoid becomes longer towards the points. A hull gets no more vertices, unless it
/// is too thin for that: points become vertices where others vanish, else faces move outwards.
Element enlarged(const Element& element, std::span<const Vec3> points, double room);
/// Returns about the volume that enlarged() adds for the points.
double added_volume(const Element& element, std::span<const Vec3> points);

/// Returns a direction of the link's frame in that of the element.
inline Vec3 turned_back(const Element& e, const Vec3& v) {
    const auto& r = e.pose.rotation;
    return r[0] * v.x + r[1] * v.y + r[2] * v.z;
}

/// Returns a point of the link's frame in that of the element.
inline Vec3 to_own_frame(const Element& e, const Vec3& p) {
    return turned_back(e, p - e.pose.translation);
}

/// A primitive of a solid at its pose, for many queries.
class PrimitivePart {
public:
    /// `primitive`: in its own frame.
    PrimitivePart(const Element& primitive, const Pose& pose) : element_(primitive), to_local_(pose.inverse()) {}

    double signed_distance(const Vec3& p) const { return kind_of(element_).signed_distance(element_, to_local_ * p); }
    double volume() const { return foam::volume(element_); }
    std::optional<LinePart> inside_along(const Vec3& origin, const Vec3& direction) const {
        return kind_of(element_).inside_along(element_, to_local_ * origin, to_local_.rotate(direction));
    }

private:
    Element element_;
    Pose to_local_;
};

} // namespace foam::inline geometry
