#include <foam/search/refine.hpp>

#include "by_spheres/portfolio/searches.hpp"

#include <algorithm>
#include <limits>

namespace foam::inline search {
namespace {

/// Margin as a share of the solid's size: for rounding of written numbers and for covers in single precision.
constexpr double room = 2e-5;
/// Overlap as a share of the radii: where spheres barely meet, a proof would have to subdivide finely.
constexpr double overlap = 1e-4;

/// Returns limits for the balls such that the spheres, slightly larger, keep the half-space constraints.
by_spheres::Limits limits_of(const std::vector<ClipPlane>& planes, const by_spheres::Frame& frame) {
    by_spheres::Limits limits;
    for (const ClipPlane& plane : planes) {
        const Vec3 normal = normalized(plane.normal);
        const double offset = (plane.offset + plane.reach - dot(normal, frame.origin)) / frame.unit;
        limits.push_back({normal / (1 + overlap), (offset - 2 * room) / (1 + overlap)});
    }
    return limits;
}

} // namespace

bool keep_constraints(const Solid& solid, const std::vector<Sphere>& spheres, const std::vector<ClipPlane>& planes) {
    return violation_of(planes, spheres) <= -room * by_spheres::Frame(solid.bounds()).unit;
}

std::vector<Sphere> covering_within(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t count,
                                    const std::vector<ClipPlane>& planes, std::uint64_t seed) {
    const by_spheres::Frame frame(solid.bounds());
    std::vector<Sphere> result;
    for (const by_spheres::Ball& b : by_spheres::LimitedSearch(solid, frame, limits_of(planes, frame), count, seed)
                                    .cover(by_spheres::unit_balls(spheres, frame))) {
        const double radius = static_cast<double>(b.r) * (1 + overlap) + room / 2;
        result.push_back({frame.from_unit({b.x, b.y, b.z}), radius * frame.unit});
    }
    return result;
}

std::vector<Sphere> shrunk_within(const Solid& solid, std::vector<Sphere> spheres,
                                  const std::vector<ClipPlane>& planes) {
    constexpr int rounds = 8; // a sphere moved off one plane comes nearer to another that faces it
    const double spare = room * by_spheres::Frame(solid.bounds()).unit;
    const auto largest_violation = [&](const Sphere& sphere) {
        double most = -std::numeric_limits<double>::infinity();
        for (const ClipPlane& plane : planes) {
            most = std::max(most, reach_beyond(plane, sphere) - plane.reach);
        }
        return most;
    };
    for (Sphere& sphere : spheres) {
        for (int round = 0; round < rounds && largest_violation(sphere) > -spare; ++round) {
            for (const ClipPlane& plane : planes) {
                const double over = reach_beyond(plane, sphere) - plane.reach + spare;
                if (over > 0) {
                    sphere.center -= normalized(plane.normal) * (over / 2);
                    sphere.radius = std::max(0.0, sphere.radius - over / 2);
                }
            }
        }
    }
    std::erase_if(spheres, [](const Sphere& sphere) { return !(sphere.radius > 0); });
    return spheres;
}

} // namespace foam::search
