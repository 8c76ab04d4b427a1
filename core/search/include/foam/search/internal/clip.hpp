// Spheres that keep half-space constraints, whatever spherizer they are from.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/solid.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

/// Throws Error(geometry) if the solid itself extends as far beyond a plane as spheres may. `pose`: of the solid's
/// frame in that of the planes.
void require_within(const Solid& solid, const Pose& pose, const std::vector<ClipPlane>& planes);

/// Returns whether the spheres keep the half-space constraints, by more than the rounding of their numbers.
bool keep_constraints(const Solid& solid, const std::vector<Sphere>& spheres, const std::vector<ClipPlane>& planes);

/// Returns at most `count` spheres that cover the solid and keep the half-space constraints, made from the given
/// spheres, which need not keep them. The result is slightly larger than needed and has a slightly larger distance to
/// the planes, so that its numbers can be rounded.
std::vector<Sphere> covering_within(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t count,
                                    const std::vector<ClipPlane>& planes, std::uint64_t seed);

/// Returns for each sphere the largest sphere in it that keeps the half-space constraints; leaves out spheres that have
/// none. The result need not cover anything.
std::vector<Sphere> shrunk_within(const Solid& solid, std::vector<Sphere> spheres,
                                  const std::vector<ClipPlane>& planes);

/// Returns the largest length by which spheres extend farther than the half-space constraints allow, m. Negative: all
/// constraints are kept.
double violation_of(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres);

/// Returns for each plane how far the spheres extend beyond it.
std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres);

/// Returns a sentence for each half-space constraint, counted from 1, that is not kept.
std::vector<std::string> not_kept(const std::vector<PlaneReach>& planes);

} // namespace search
} // namespace foam
