// Exact queries on primitives.
#pragma once

#include <foam/geometry/primitive.hpp>
#include <foam/geometry/solid.hpp>

#include <optional>

namespace foam::inline geometry {

/// A primitive at a pose.
class PrimitivePart {
public:
    PrimitivePart(const Primitive& primitive, const Pose& pose);

    /// Returns the distance to the surface, negative inside: exact.
    double signed_distance(const Vec3& p) const;
    double volume() const;
    /// Returns the part of the line origin + t · direction inside; a primitive is convex, so there is at most one.
    std::optional<Solid::Interval> inside_along(const Vec3& origin, const Vec3& direction) const;

private:
    Primitive primitive_;
    Pose to_local_;
};

/// Throws Error(geometry) unless all lengths that its kind uses are finite and above zero.
void check_primitive(const Primitive& primitive);

} // namespace foam::geometry
