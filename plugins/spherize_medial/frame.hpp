// A normalised frame for each shape: origin at its middle, axes along its principal directions, size 1. All work of
// this plugin takes place in it, so that a part of 0.1 µm, a part far from the origin and an inclined part are all the
// same.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/sphere.hpp>

#include <array>

namespace foam::medial {

struct Frame {
    Vec3 origin;              ///< m, link frame
    std::array<Vec3, 3> axes; ///< unit; the last is the direction of least extent
    double scale = 1;         ///< m per unit

    Vec3 to_local(const Vec3& p) const;
    Vec3 to_world(const Vec3& p) const;
    Vec3 direction_to_world(const Vec3& v) const { return axes[0] * v.x + axes[1] * v.y + axes[2] * v.z; }
    /// Returns the sphere in the link frame, with its radius rounded up by what the change of coordinates may lose.
    Sphere sphere_to_world(const Sphere& sphere) const;
};

/// Returns the principal axes by the second moments of the surface; the coordinate axes where the moments are
/// undetermined. The largest extent of the surface becomes 1. Throws Error(geometry) if the surface has no extent or is
/// too large to compute with.
Frame principal_frame(const Mesh& surface);

} // namespace foam::medial
