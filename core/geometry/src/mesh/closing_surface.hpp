// Triangles that close an open surface.
#pragma once

#include "mesh/orientation.hpp"

namespace foam::inline geometry {

/// Returns a surface over the rim of the triangles that count, wound so that both together pass every edge as often one
/// way as the other. Their winding number is then a whole number, which the crossings of a line determine. The winding
/// number of the triangles is this number minus that of the closing surface, which is small where holes are (as the
/// integral over the boundary in Martens and Bessmeltsev 2025, One-Shot Method for Computing Generalized Winding
/// Numbers).
///
/// Any such surface is correct; one of small area is best. Ribbons join corners of the rim that nearly coincide, so
/// that the two sides of a crack cancel. The remaining edges form closed curves, each filled with a fan of triangles to
/// its centroid. Empty if the surface is closed.
Mesh closing_surface(const Mesh& mesh, const Reading& reading);

} // namespace foam::geometry
