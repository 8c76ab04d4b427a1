#include <foam/search/internal/clip.hpp>

#include "limited_search.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline search {
namespace {

/// Margin as a share of the solid's size: for rounding of written numbers and for covers in single precision.
constexpr double room = 2e-5;
/// Overlap as a share of the radii: where spheres barely meet, a proof would have to subdivide finely.
constexpr double overlap = 1e-4;

std::string name_of(const ClipPlane& plane, std::size_t number) {
    return fmt::format("plane {} of 'clip' ({})", number, text_of(plane));
}

/// Returns limits for the balls such that the spheres, slightly larger, keep the half-space constraints.
cover::Limits limits_of(const std::vector<ClipPlane>& planes, const cover::Frame& frame) {
    cover::Limits limits;
    for (const ClipPlane& plane : planes) {
        const Vec3 normal = normalized(plane.normal);
        const double offset = (plane.offset + plane.reach - dot(normal, frame.origin)) / frame.unit;
        limits.push_back({normal / (1 + overlap), (offset - 2 * room) / (1 + overlap)});
    }
    return limits;
}

} // namespace

void require_within(const Solid& solid, const Pose& pose, const std::vector<ClipPlane>& planes) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
        double most = -std::numeric_limits<double>::infinity();
        for (const Vec3& vertex : solid.surface().vertices) {
            most = std::max(most, reach_beyond(planes[i], Sphere{pose * vertex, 0}));
        }
        if (most >= planes[i].reach) {
            throw Error(ErrorCode::geometry,
                        fmt::format("the geometry itself reaches {:.4g} m beyond {}, and spheres may reach {} m beyond "
                                    "it; remedy: raise the plane's offset, or its reach to more than {:.4g}",
                                    most, name_of(planes[i], i + 1), number_text(planes[i].reach), most));
        }
    }
}

bool keep_constraints(const Solid& solid, const std::vector<Sphere>& spheres, const std::vector<ClipPlane>& planes) {
    return violation_of(planes, spheres) <= -room * cover::Frame(solid.bounds()).unit;
}

std::vector<Sphere> covering_within(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t count,
                                    const std::vector<ClipPlane>& planes, std::uint64_t seed) {
    const cover::Frame frame(solid.bounds());
    std::vector<Sphere> result;
    for (const cover::Ball& b : cover::LimitedSearch(solid, frame, limits_of(planes, frame), count, seed)
                                    .cover(cover::unit_balls(spheres, frame))) {
        const double radius = static_cast<double>(b.r) * (1 + overlap) + room / 2;
        result.push_back({frame.from_unit({b.x, b.y, b.z}), radius * frame.unit});
    }
    return result;
}

std::vector<Sphere> shrunk_within(const Solid& solid, std::vector<Sphere> spheres,
                                  const std::vector<ClipPlane>& planes) {
    constexpr int rounds = 8; // a sphere moved off one plane comes nearer to another that faces it
    const double spare = room * cover::Frame(solid.bounds()).unit;
    for (Sphere& sphere : spheres) {
        for (int round = 0; round < rounds && violation_of(planes, {&sphere, 1}) > -spare; ++round) {
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

double violation_of(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres) {
    double most = -std::numeric_limits<double>::infinity();
    for (const ClipPlane& plane : planes) {
        most = std::max(most, reach_beyond(plane, spheres) - plane.reach);
    }
    return most;
}

std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres) {
    std::vector<PlaneReach> result;
    for (const ClipPlane& plane : planes) {
        result.push_back({plane, reach_beyond(plane, spheres)});
    }
    return result;
}

std::vector<std::string> not_kept(const std::vector<PlaneReach>& planes) {
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (!planes[i].kept()) {
            sentences.push_back(fmt::format("its spheres reach {:.4g} m beyond {}, reach allows {} m; remedy: more "
                                            "spheres for the robot or for this link, or a larger reach",
                                            planes[i].reached, name_of(planes[i].plane, i + 1),
                                            number_text(planes[i].plane.reach)));
        }
    }
    return sentences;
}

} // namespace foam::search
