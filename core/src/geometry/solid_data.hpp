// What a Solid holds.
#pragma once

#include "geometry/inside_lines.hpp"
#include "geometry/mesh_part.hpp"
#include "geometry/primitive.hpp"

#include <foam/solid.hpp>

#include <mutex>

namespace foam::geometry {

/// One part of the union, ready for queries.
struct PartQueries {
    MeshPart mesh; ///< of a primitive: its tessellation
    std::optional<PrimitivePart> primitive;
    Box box; ///< of the tessellation

    bool closed() const { return primitive.has_value() || mesh.closed(); }
    bool contains(const Vec3& p) const { return primitive ? primitive->signed_distance(p) <= 0 : mesh.contains(p); }
    /// Of one part on its own; of a mesh that is not closed: with what closes it.
    double volume() const { return primitive ? primitive->volume() : mesh.signed_volume(); }
};

struct SolidData {
    std::vector<Solid::Part> parts;
    Mesh surface;
    std::vector<std::uint32_t> offsets;
    Box box;
    double area = 0;
    bool closed = true;
    std::vector<PartQueries> queries;

    mutable std::once_flag lines_once;
    mutable std::unique_ptr<const InsideLines> lines;

    bool is_primitive() const { return queries.size() == 1 && queries[0].primitive; }
    /// As Solid::inside_along().
    Intervals inside_along(const Vec3& origin, const Vec3& direction, std::span<const Solid::Interval> within) const;
};

/// Where the winding number of a mesh and what closes it, or the inside of a primitive, begins and ends along a line:
/// pieces of a piece-wise constant function. Appends to `pieces`.
struct WindingPiece {
    double enter, leave;
    int winding;
};
void winding_along(const PartQueries& part, const Vec3& origin, const Vec3& direction, std::vector<Crossing>& scratch,
                   std::vector<WindingPiece>& pieces);
/// All of a line.
inline constexpr std::array<Solid::Interval, 1> whole_line{
    {{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}}};

} // namespace foam::geometry

namespace foam {
struct Solid::Data : geometry::SolidData {};
} // namespace foam
