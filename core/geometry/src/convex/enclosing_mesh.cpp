// Polyhedra that enclose primitives: a profile that circumscribes the round outline, turned about the axis with
// polygons that circumscribe the circle.
#include "convex/enclosing_mesh.hpp"

#include <numbers>

namespace foam::inline geometry {
namespace {

using std::numbers::pi;

/// A corner of the profile: distance from the axis and height.
struct ProfilePoint {
    double across, z;
};

/// Returns the profile from bottom to top, turned about z and closed by flat discs. Every cross-section is a regular
/// polygon around the circle of the primitive.
Mesh turned(const std::vector<ProfilePoint>& profile, int segments) {
    const auto n = static_cast<std::uint32_t>(segments);
    const auto rings = static_cast<std::uint32_t>(profile.size());
    const double circumscribed = (1 + 8 * std::numeric_limits<double>::epsilon()) / std::cos(pi / segments);
    Mesh mesh;
    for (const ProfilePoint& point : profile) {
        for (std::uint32_t k = 0; k < n; ++k) {
            const double angle = 2 * pi * k / segments;
            mesh.vertices.push_back({point.across * circumscribed * std::cos(angle),
                                     point.across * circumscribed * std::sin(angle), point.z});
        }
    }
    const std::uint32_t bottom = rings * n, top = bottom + 1;
    mesh.vertices.push_back({0, 0, profile.front().z});
    mesh.vertices.push_back({0, 0, profile.back().z});
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t next = (k + 1) % n;
        mesh.triangles.push_back({bottom, next, k});
        for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
            const std::uint32_t low = ring * n, high = low + n;
            mesh.triangles.push_back({low + k, low + next, high + next});
            mesh.triangles.push_back({low + k, high + next, high + k});
        }
        mesh.triangles.push_back({top, (rings - 1) * n + k, (rings - 1) * n + next});
    }
    return mesh;
}

/// Returns the tangents at the poles, at the equator and between them; `half`: half the length of the cylindrical part.
std::vector<ProfilePoint> capsule_profile(double radius, double half, int segments) {
    const int steps = std::max(1, segments / 4);
    const double step = pi / 2 / steps;
    const double reach = radius * (1 + 8 * std::numeric_limits<double>::epsilon()) / std::cos(step / 2);
    std::vector<ProfilePoint> profile;
    for (int k = steps - 1; k >= 0; --k) {
        profile.push_back({reach * std::sin((k + 0.5) * step), reach * std::cos((k + 0.5) * step) + half});
    }
    std::vector<ProfilePoint> result;
    for (auto point = profile.rbegin(); point != profile.rend(); ++point) {
        result.push_back({point->across, -point->z});
    }
    result.insert(result.end(), profile.begin(), profile.end());
    return result;
}

} // namespace

Mesh box_mesh(const Vec3& half) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.vertices.push_back(
            {corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z});
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

Mesh capsule_mesh(double radius, double half, int segments) {
    return turned(capsule_profile(radius, half, segments), segments);
}

Mesh cylinder_mesh(double radius, double half, int segments) {
    return turned({{radius, -half}, {radius, half}}, segments);
}

} // namespace foam::inline geometry
