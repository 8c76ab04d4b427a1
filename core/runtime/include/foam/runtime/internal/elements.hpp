// Elements of any kind in the work of a run: their place, their numbers, their limits.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/runtime/shown_elements.hpp>
#include <foam/sdk/kinds.hpp>

#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns a level of these elements, without parents.
Approximation::Level level_of(const ElementsView& elements);
/// Adds the elements of one level to another, without parents.
void append(Approximation::Level& level, const ElementsView& more);
/// Returns the level or the approximation in another frame; `pose`: of its frame in that one.
Approximation::Level moved(Approximation::Level level, const Pose& pose);
Approximation moved(Approximation approximation, const Pose& pose);
/// Returns the level as a program holds it that reads its numbers in single precision. Hulls are made again from their
/// rounded vertices. Throws Error(geometry) where these lie in a plane.
Approximation::Level in_single_precision(Approximation::Level level);

/// Returns what violation_of() of clip_plane.hpp does, for elements of any kind.
double violation_of(const std::vector<ClipPlane>& planes, const ElementsView& elements);

} // namespace runtime
} // namespace foam
