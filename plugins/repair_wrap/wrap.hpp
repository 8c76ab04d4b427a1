// The alpha wrap of a triangle soup.
#pragma once

#include <foam/geometry/mesh.hpp>

namespace foam::repair {

/// Returns the closed surface that shrink-wraps the triangles at distance `offset`, entering openings wider than
/// `alpha`. Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez: Alpha Wrapping with an Offset, SIGGRAPH 2022;
/// encloses the input. Preconditions: finite vertices, indices in range, alpha and offset above 0, in the mesh's unit.
Mesh alpha_wrap(const Mesh& mesh, double alpha, double offset);

} // namespace foam::repair
