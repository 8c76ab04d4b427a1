// Holes: closed loops of open edges.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <cstddef>

namespace foam::repair {

/// Fills holes with triangles between their vertices, of least area (Barequet, Sharir: Filling gaps in the boundary of
/// a polyhedron, 1995). A hole is filled if its loop is flat, whatever its size: at a flat opening the winding number
/// is one half exactly on its plane, so nothing is guessed. Other holes are filled if their extent is at most
/// `largest`. Returns the number of holes filled. O(e³) in the edges of a hole; holes of more than 500 edges stay open.
/// Precondition: triangles at an edge face the same way.
std::size_t fill_holes(Mesh& mesh, double largest, Context& context);

} // namespace foam::repair
