#include <foam/geometry/clip_plane.hpp>

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline geometry {

double reach_beyond(const ClipPlane& plane, const Sphere& sphere) {
    return dot(normalized(plane.normal), sphere.center) + sphere.radius - plane.offset;
}

double reach_beyond(const ClipPlane& plane, std::span<const Sphere> spheres) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Sphere& sphere : spheres) {
        most = std::max(most, reach_beyond(plane, sphere));
    }
    return most;
}

std::string text_of(const ClipPlane& plane) {
    const Vec3& n = plane.normal;
    return fmt::format("normal [{}, {}, {}], offset {} m", number_text(n.x), number_text(n.y), number_text(n.z),
                       number_text(plane.offset));
}

ClipPlane seen_from(const ClipPlane& plane, const Pose& pose) {
    ClipPlane seen = plane;
    seen.normal = pose.inverse().rotate(plane.normal);
    seen.offset -= dot(normalized(plane.normal), pose.translation);
    return seen;
}

} // namespace foam::geometry
