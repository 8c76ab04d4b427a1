// Convex elements, of a robot's geometry and of an approximation: spheres, capsules, cylinders, boxes, swept boxes,
// hulls and ellipsoids.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A convex polytope, the hull of its vertices. Immutable once made, and shared by copies of its element.
struct Polytope {
    /// A half-space that contains the polytope: dot(normal, p) <= offset for all its points p.
    struct Face {
        Vec3 normal; ///< unit, outwards
        double offset = 0;

        bool operator==(const Face&) const = default;
    };
    Mesh surface;            ///< closed and convex, wound outwards; every vertex is a vertex of the polytope
    std::vector<Face> faces; ///< one for each plane of the surface; offsets are rounded outwards

    bool operator==(const Polytope&) const = default;
};

/// Returns the convex hull of the points: no point is outside by more than the rounding of its coordinates, and the
/// offsets of its faces contain every point. O(n log n) expected. Throws Error(geometry) if the points are not finite
/// or lie in a plane.
std::shared_ptr<const Polytope> convex_hull(std::span<const Vec3> points);

/// A convex body at a pose. Metres. All kinds but the hull are centred at the origin of their own frame: a core, widened
/// by `radius` in all directions. src/convex has a file for each core, and kinds.cpp the table of the kinds.
struct Element {
    enum class Kind {
        sphere,    ///< radius
        capsule,   ///< half.z, radius: a segment along z, widened
        cylinder,  ///< half.z, radius: along z, with flat ends
        box,       ///< half
        swept_box, ///< half, radius: a box with round edges
        hull,      ///< hull
        ellipsoid, ///< half: the lengths of its half axes
    };
    Kind kind = Kind::sphere;
    Pose pose{};                            ///< from the element's frame to the link's
    Vec3 half{};                            ///< half the edge lengths, or half axes; what a kind does not use is 0
    double radius = 0;                      ///< what a kind does not use is 0
    std::shared_ptr<const Polytope> hull{}; ///< in the element's frame; null for other kinds

    // Elements about the origin, along z.
    static Element sphere(double radius) { return {.radius = radius}; }
    /// `length`: without the caps.
    static Element capsule(double radius, double length) {
        return {.kind = Kind::capsule, .half = {0, 0, length / 2}, .radius = radius};
    }
    static Element cylinder(double radius, double length) {
        return {.kind = Kind::cylinder, .half = {0, 0, length / 2}, .radius = radius};
    }
    /// `size`: the edge lengths.
    static Element box(const Vec3& size) { return {.kind = Kind::box, .half = size * 0.5}; }
    /// `radii`: the lengths of the half axes.
    static Element ellipsoid(const Vec3& radii) { return {.kind = Kind::ellipsoid, .half = radii}; }

    /// Hulls are compared by their content.
    bool operator==(const Element& other) const;
};

constexpr std::size_t element_kinds = 7;
/// Returns all kinds, in the order of their values.
std::vector<Element::Kind> every_kind();
/// Returns the word of recipes and files: "swept_box".
const char* to_string(Element::Kind kind);
/// Returns the kind of a word; nothing for any other word.
std::optional<Element::Kind> element_kind_named(std::string_view word);
/// Returns what a kind has besides its pose, by the names of recipes and files: "radius", "length" (without caps), "size"
/// (the edge lengths), "radii" (the half axes) and "vertices".
std::span<const std::string_view> number_names(Element::Kind kind);

/// Returns whether all numbers are finite, the rotation is orthonormal to 1e-6, lengths are not negative and the
/// element has a volume.
bool is_valid(const Element& element);
/// Returns whether the element contains the point, with `slack` metres to spare in every direction (0: on the boundary
/// counts). Exact but for rounding. O(faces) for a hull.
bool holds(const Element& element, const Vec3& point, double slack = 0);
/// Returns the distance from the element to the point, exact to rounding; negative inside, the largest slack with which
/// the element holds the point. Outside a hull it is the largest distance to a plane, which is a lower bound.
double signed_distance(const Element& element, const Vec3& point);
/// Returns the same; 0 inside.
double distance(const Element& element, const Vec3& point);
/// Returns the farthest point of the element along `direction`, in the link's frame.
Vec3 support(const Element& element, const Vec3& direction);
/// Returns the tight axis-aligned box, in the link's frame.
Box bounds(const Element& element);
/// Returns the radius by which a core is widened in all directions; 0 for a kind with a core that has edges of its own.
double widening(const Element& element);
/// Returns the volume, m³, exact to rounding.
double volume(const Element& element);
/// Returns the least extent along an axis of its own frame, m.
double thickness(const Element& element);
/// Returns the part of the line origin + t · direction in the element; direction need not be unit. Exact to rounding.
struct LinePart {
    double enter, leave;
};
std::optional<LinePart> inside_along(const Element& element, const Vec3& origin, const Vec3& direction);
/// Returns an element of the same kind that contains the element and everything within `length` metres of it. For
/// spheres, capsules and swept boxes it is exactly that. Boxes, cylinders and hulls keep sharp edges, and an ellipsoid
/// keeps its form; they contain more.
Element grown(const Element& element, double length);
/// Returns the element at another pose: `pose` maps its frame to the new one.
Element moved(Element element, const Pose& pose);
/// Returns a closed, outward mesh that contains the element, round parts circumscribed, in the link's frame. A box and
/// a hull are exact. `segments`: around a circle, at least 3.
Mesh enclosing_mesh(const Element& element, int segments = 48);

} // namespace geometry
} // namespace foam
