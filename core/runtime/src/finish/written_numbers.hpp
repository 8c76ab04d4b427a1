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

/// Grows elements until they are proved to cover as they are, by 4095 steps of the grid at most. Elements that cover may
/// not be proved to once their lengths are rounded up: where they only just overlap, pieces of the surface become too
/// small for a proof.
void grow_until_proved(const Solid& solid, Elements& elements, const DecimalGrid& grid);

/// Moves the elements of a level that has not only spheres onto the grid, grows them to cover if they are to be `outer`,
/// and rounds their lengths up. Returns the largest growth of a length, m.
double finish_elements(const Solid& solid, Elements& elements, const DecimalGrid& grid, bool outer,
                       Numbers numbers);

} // namespace foam::runtime
