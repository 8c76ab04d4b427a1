// Spheres that keep off planes, whatever spherizer they are from.
#pragma once

#include <foam/host/clip_plane.hpp>
#include <foam/solid.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace foam {

/// Throws Error(geometry) if the solid itself reaches as far beyond a plane as spheres may. `pose`: of the solid's
/// frame in that of the planes.
void require_within(const Solid& solid, const Pose& pose, const std::vector<ClipPlane>& planes);

/// Whether the spheres keep off the planes, by more than rounding their numbers may take.
bool keep_off(const Solid& solid, const std::vector<Sphere>& spheres, const std::vector<ClipPlane>& planes);

/// Spheres that hold the solid, at most `count`, and keep off the planes: made of those given, which need not. They are
/// a hair larger than they need be, and keep a hair more off, so that numbers can be rounded.
std::vector<Sphere> covering_within(const Solid& solid, const std::vector<Sphere>& spheres, std::size_t count,
                                    const std::vector<ClipPlane>& planes, std::uint64_t seed);

/// Of each sphere the largest one in it that keeps off the planes; spheres of which nothing is left are left out. For
/// spheres that need not hold anything.
std::vector<Sphere> shaved(const Solid& solid, std::vector<Sphere> spheres, const std::vector<ClipPlane>& planes);

/// By how much spheres reach farther than the planes allow, m: the largest.
double over_planes(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres);

/// What came of the planes.
std::vector<PlaneReach> reached(const std::vector<ClipPlane>& planes, std::span<const Sphere> spheres);

/// A sentence for each plane, counted from 1, that is not kept.
std::vector<std::string> not_kept(const std::vector<PlaneReach>& planes);

} // namespace foam
