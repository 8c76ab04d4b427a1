// Geometry in an own frame: huge, tiny or distant geometry is processed at a size of about 1 about the origin.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/geometry/vector.hpp>

#include <memory>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Bounds within which foam covers and proves (docs/guide/meshes.md). Proofs shrink spheres by their rounding errors,
/// some 1e-15 of the distance from the origin: at the farthest place that is a few millionths of the size, as much as
/// the rounding of written numbers. Sizes are in m, the place in sizes.
inline constexpr double smallest_size = 1e-12, largest_size = 1e9, farthest_place = 1e9;

/// Returns the diagonal of the box, without intermediate overflow.
double size_of(const Box& box);
/// Returns why geometry of that size cannot be processed: "its size is 1e+200 m, …"; empty if it can.
std::string why_bad_size(double size);
/// Returns the same for a place: the middle of the geometry.
std::string why_bad_place(const Vec3& middle, double size);
/// Returns the first of these two reasons for geometry within the box; empty if there is none.
std::string why_out_of_bounds(const Box& box);
/// Returns the bounds of the triangles' corners: vertices of no triangle do not count.
Box bounds_of_corners(const Mesh& mesh);

/// An own frame. Own coordinates are those of the given frame minus `origin`, times 2^exponent. Where geometry does not
/// reach from one power of two to another, there and back is exact.
struct OwnFrame {
    Vec3 origin{};
    int exponent = 0;
    double dust = 0; ///< smaller own coordinates become 0: predicates in exact arithmetic fail on them

    bool operator==(const OwnFrame&) const = default;
    bool is_given() const { return *this == OwnFrame{}; }
    /// Returns the number of own lengths in a metre.
    double scale() const;
    Vec3 to_own(const Vec3& point) const;
    Vec3 from_own(const Vec3& point) const;
    Mesh to_own(Mesh mesh) const;
    Mesh from_own(Mesh mesh) const;
    std::shared_ptr<const Solid> to_own(const Solid& solid) const;
    Shape to_own(const Shape& shape) const;
    std::vector<Sphere> from_own(std::vector<Sphere> spheres) const;
    Element from_own(Element element) const;
    Approximation from_own(Approximation tree) const;
};

/// Returns whether a coordinate is so small against the size of the mesh, and not 0, that it may be dust in some frame.
bool may_have_dust(const Mesh& mesh);
/// Returns the own frame. It is the given frame for ordinary geometry: of size 2^-20 to 2^20 m, no farther from the
/// origin than 1024 times its size along any axis, and without dust.
OwnFrame own_frame(const Box& box, bool dusty);
OwnFrame own_frame(const Mesh& mesh);
OwnFrame own_frame(const Solid& solid);

/// Returns the axis-aligned box around the corners of a box at a pose.
inline Box posed(const Box& box, const Pose& pose) {
    Box result;
    for (int corner = 0; corner < 8; ++corner) {
        result.add(pose * Vec3{corner & 1 ? box.low.x : box.high.x, corner & 2 ? box.low.y : box.high.y,
                               corner & 4 ? box.low.z : box.high.z});
    }
    return result;
}

} // namespace geometry
} // namespace foam
