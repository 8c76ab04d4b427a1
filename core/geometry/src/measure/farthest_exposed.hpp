// The largest protrusion of an element, with a bound.
#pragma once

#include <foam/geometry/element.hpp>
#include <foam/geometry/solid.hpp>

#include <functional>
#include <span>

namespace foam::inline geometry {

/// Returns the largest distance from a solid of a point of the element's surface that is exposed, by branch and bound:
/// no such point is farther by more than 1 %, unless 4,000 pieces of the surface do not suffice to tell. `known`: a
/// distance that is reached. `near`: the other elements that come near. `exposed(point, normal)`: whether a point of
/// the surface is.
double farthest_exposed(const Solid& solid, const Element& element, std::span<const Element> near, double known,
                        const std::function<bool(const Vec3&, const Vec3&)>& exposed);

} // namespace foam::inline geometry
