// Growth of elements until they leave no cavity in a solid.
#pragma once

#include <foam/geometry/elements.hpp>
#include <foam/geometry/solid.hpp>

namespace foam::inline geometry {

/// Returns elements that hold the surface of a solid, grown until they are proved to hold the solid, too; those that do
/// stay as they are. What is left open of the inside goes to the element that adds the least volume.
Elements grown_to_fill(const Solid& solid, Elements elements);

} // namespace foam::inline geometry
