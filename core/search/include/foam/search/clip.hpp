// Spheres that keep half-space constraints, whatever spherizer they are from.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/solid.hpp>

#include <cstdint>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] search {

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

} // namespace search
} // namespace foam
