// A solid with the queries of spherizers, measures and proofs.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/element.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A point on a surface.
struct SurfacePoint {
    Vec3 point;
    Vec3 normal;                ///< unit, of the triangle; zero for a degenerate one
    std::uint32_t triangle = 0; ///< index into Solid::surface().triangles
};

/// What elements around a solid are to hold.
enum class Covers {
    solid,   ///< all of it, with its inside
    surface, ///< its surface alone: what is open has no inside for certain
};

/// Returns "solid" or "surface".
const char* to_string(Covers covers);

/// The union of closed parts (meshes, primitives) in one frame, metres. It is immutable; every query is const and
/// thread-safe. A mesh that is not closed counts as the set of points whose generalised winding number (Jacobson et al.
/// 2013) is above one half. The surface belongs to the solid. Raw meshes are interpreted as their authors must have
/// meant them: inside-out meshes and bodies are flipped, patches with mixed winding are made consistent, duplicate and
/// double-sided faces count once; a double-sided sheet has no inside. Shells of one winding unite; a shell wound
/// inwards in another is a cavity.
class Solid {
public:
    /// A part: a mesh as is, or a primitive at a pose.
    struct Part {
        std::shared_ptr<const Mesh> mesh; ///< in the solid's frame; null for a primitive
        std::optional<Element> primitive;
        Pose pose; ///< of the primitive; ignored for a mesh
        /// surface: no cover has to hold its inside, even where it has one.
        Covers covers = Covers::solid;
    };

    /// Builds the acceleration structures: O(n log n) in the triangles. Throws Error(geometry) if there is no triangle
    /// at all or a vertex is not finite.
    static std::shared_ptr<const Solid> make(std::vector<Part> parts);
    static std::shared_ptr<const Solid> make(Mesh mesh);
    ~Solid();
    Solid(const Solid&) = delete;
    Solid& operator=(const Solid&) = delete;

    const std::vector<Part>& parts() const;
    /// All triangles of all parts, in order, wound outwards where the outside is known; primitives as meshes that
    /// enclose them. Overlaps and defects stay.
    const Mesh& surface() const;
    /// Index of the first triangle of each part in surface(), and one past the last: parts().size() + 1 values.
    std::span<const std::uint32_t> part_offsets() const;
    const Box& bounds() const;
    /// Area of surface(), m².
    double area() const;
    /// Volume of the union, m³. It is exact for one closed part that does not overlap itself and for one primitive;
    /// otherwise it is integrated along lines, with a relative error of about 1e-3. It is 0 for a mesh thinner than the
    /// accuracy of lines, a billionth of its size.
    double volume() const;
    /// Standard error of volume(), m³; 0 where the volume is exact. It includes differences between neighbouring lines,
    /// so it tends to be too large.
    double volume_error() const;
    /// Returns false if a part is a mesh with holes, whose inside depends on the winding number.
    bool closed() const;
    /// Returns what covers of it are to hold: its surface alone if a part is a mesh with holes, or says so itself. The
    /// other parts are held with their insides all the same.
    Covers covers() const;

    /// Returns the nearest point of surface(). O(log n). For a round primitive it lies on the tessellation.
    SurfacePoint closest(const Vec3& point) const;
    /// Returns whether the point is inside or on the surface.
    bool contains(const Vec3& point) const;
    /// Returns the distance to the surface, negative inside. Primitives are exact. Inside a union it is the largest
    /// depth in any one part: never more than the distance to the union's surface.
    double signed_distance(const Vec3& point) const;
    /// Returns `count` points uniform by area (stratified over the triangles), the same for the same seed.
    std::vector<SurfacePoint> sample_surface(std::size_t count, std::uint64_t seed) const;

    struct Interval {
        double enter, leave;
    };
    /// Returns the parts of the line origin + t · direction inside the solid, ascending and disjoint; direction need
    /// not be unit. Where a mesh is not closed, short parts near its holes have the accuracy of the winding number.
    std::vector<Interval> inside_along(const Vec3& origin, const Vec3& direction) const;
    /// Returns the same within `parts` of the line, which are ascending and disjoint; the rest is not examined.
    std::vector<Interval> inside_along(const Vec3& origin, const Vec3& direction,
                                       std::span<const Interval> parts) const;
    /// Returns the volume of the solid outside all spheres, vol(S \ U), m³; 0 if they leave nothing out. It is
    /// integrated along a grid of lines that is the same for all spheres, so it is good for comparing them; the error
    /// is about 1e-3 of the volume. It is quick: only the first call computes where the lines run inside.
    double missing_volume(std::span<const Sphere> spheres) const;

private:
    friend struct SolidAccess; ///< foam::geometry's own
    struct Data;
    explicit Solid(std::unique_ptr<const Data> data);
    std::unique_ptr<const Data> data_;
};

/// Returns the solid of the same parts of which covers are to hold the surface alone.
std::shared_ptr<const Solid> as_surface(const Solid& solid);

/// The input of a spherizer: the geometry of a link (or of one collision element), in the link's frame.
class Shape {
public:
    /// `processed`: the result of the mesh filters, closed where they promise so. `original`: the original geometry,
    /// which the spheres must cover.
    Shape(std::string name, std::shared_ptr<const Solid> processed, std::shared_ptr<const Solid> original);
    ~Shape();
    Shape(const Shape&);
    Shape& operator=(const Shape&) = delete;

    const std::string& name() const { return name_; }
    const Solid& processed() const { return *processed_; }
    const Solid& original() const { return *original_; }

private:
    std::string name_;
    std::shared_ptr<const Solid> processed_, original_;
};

} // namespace geometry
} // namespace foam
