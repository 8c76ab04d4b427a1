// The numbers that are written: decimal fractions that read back to the same bits, rounded outwards.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/internal/decimal_grid.hpp>

namespace foam::inline runtime {

/// Returns how far single precision may move a sphere's surface: half a unit in the last place of each coordinate and
/// of the radius, twice that to be safe.
double float32_slack(const Sphere& sphere, Numbers numbers);

/// Returns an element of the same kind, with lengths on the grid, that contains the element. Vertices of a hull move to
/// the grid in the link's frame, which becomes its own.
Element up_on_grid(Element element, const DecimalGrid& grid);

/// Moves the elements of a level onto the grid, grows them to cover if they are to be `outer`, and rounds their lengths
/// up. Returns the largest growth of a length, m.
double finish_elements(const Solid& solid, Approximation::Level& level, const DecimalGrid& grid, bool outer,
                       Numbers numbers);

} // namespace foam::runtime
