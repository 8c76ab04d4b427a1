// Solids for a purpose: quick to make, coarse, filled; and the cavities of one.
#pragma once

#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>

#include <memory>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the solid of these parts, whose meshes are interpreted on the first query that needs to know the inside, not
/// at once: proofs need nothing but the surface. Its surface is wound as given.
std::shared_ptr<const Solid> quick_solid(std::vector<Solid::Part> parts);

/// Returns whether covers are to hold the inside of any part.
bool has_solid_parts(const Solid& solid);

/// Returns bounds on the figures, in the time that a proof takes. All of the elements counts as excess, as if the solid
/// had no volume. Their surface counts as exposed, at the largest possible distance: the diagonal of the box around
/// both.
Measures bounds_of_measures(const Solid& solid, const Elements& elements);

/// Number of triangles above which a solid has a coarse one.
inline constexpr std::size_t many_triangles = 100'000;

/// Returns a solid with some ten thousand triangles on which searches are quick, whatever the number of triangles; null
/// if the solid has few. Of the vertices of each part in a cell of a lattice, the one nearest to the cell's middle
/// represents all (Rossignac and Borrel 1993, "Multi-resolution 3D approximations for rendering complex scenes"). The
/// two surfaces are nowhere farther apart than a cell's diagonal. Closed parts stay closed: vertices are mapped, and
/// only triangles that lose a corner are dropped. Primitives stay as they are. It is made on first use, in O(n); safe
/// from any number of threads.
std::shared_ptr<const Solid> coarse_solid(const Solid& solid);

/// Returns the solid united with its inside: with the cells of a grid from which most lines meet the solid on both
/// sides. This is the ray stabbing of Nooruddin and Turk 2003. A majority of the lines is enough, so that holes in a
/// wall do not matter. Returns the same solid if there is no such cell. A cell has 1/48 of the longest edge of the
/// solid's box; cells that meet the surface are left out, so the filled inside is smaller than the true one. Lines go
/// from cell to cell: a hole in a wall that is narrower than a cell may be closed to them. A sheet without volume meets
/// no line.
std::shared_ptr<const Solid> filled(const std::shared_ptr<const Solid>& solid);

/// Returns about the volume of the cavities of a solid that is one mesh, m³: of shells wound inwards whose holes are
/// negligible. For any other solid it returns 0, as another part may fill them.
double cavity_volume(const Solid& solid);

} // namespace geometry
} // namespace foam
