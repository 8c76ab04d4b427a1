// Elements of any kind in the work of a run: their place, their numbers.
#pragma once

#include <foam/geometry/sphere.hpp>
#include <foam/runtime/shown_elements.hpp>
#include <foam/sdk/kinds.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the approximation in another frame; `pose`: of its frame in that one.
Approximation moved(Approximation approximation, const Pose& pose);
/// Returns the elements as a program holds them that reads its numbers in single precision. Hulls are made again from their
/// rounded vertices. Throws Error(geometry) where these lie in a plane.
Elements in_single_precision(Elements elements);

} // namespace runtime
} // namespace foam
