// Exact solids: box, sphere, cylinder, capsule.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/vector.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// An exact solid, centred at its origin; cylinder and capsule along z. Metres.
struct Primitive {
    enum class Kind { box, sphere, cylinder, capsule };
    Kind kind = Kind::sphere;
    Vec3 size{};       ///< box: edge lengths
    double radius = 0; ///< sphere, cylinder, capsule
    double length = 0; ///< cylinder: height; capsule: height of the cylindrical part, without the caps

    bool operator==(const Primitive&) const = default;
};

const char* to_string(Primitive::Kind kind);

/// Returns a closed, outward oriented mesh that encloses the primitive (round parts circumscribed), in its own frame.
/// `segments`: around the circle, at least 3. A box is exact.
Mesh enclosing_mesh(const Primitive& primitive, int segments = 48);

} // namespace geometry
} // namespace foam
