// A solid with fewer triangles, for searches.
#pragma once

#include <foam/geometry/solid.hpp>

#include <memory>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Number of triangles above which a solid has a coarse one.
inline constexpr std::size_t many_triangles = 100'000;

/// Returns a solid with some ten thousand triangles on which searches are quick, whatever the number of triangles; null
/// if the solid has few. Of the vertices of each part in a cell of a lattice, the one nearest to the cell's middle
/// represents all (Rossignac and Borrel 1993, "Multi-resolution 3D approximations for rendering complex scenes"). The
/// two surfaces are nowhere farther apart than a cell's diagonal. Closed parts stay closed: vertices are mapped, and
/// only triangles that lose a corner are dropped. Primitives stay as they are. It is made on first use, in O(n); safe
/// from any number of threads.
std::shared_ptr<const Solid> coarse_solid(const Solid& solid);

} // namespace geometry
} // namespace foam
