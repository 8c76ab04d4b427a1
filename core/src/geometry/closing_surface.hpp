// Triangles that close an open surface.
#pragma once

#include "geometry/orientation.hpp"

namespace foam::geometry {

/// A surface over the rim of the triangles that count, wound so that both together pass every edge as often one way as
/// the other. Their winding number is then a whole number, which a line tells by what it crosses, and that of the
/// triangles is this less that of the closing surface, which is small where holes are (as the integral over the
/// boundary in Martens and Bessmeltsev 2025, One-Shot Method for Computing Generalized Winding Numbers).
///
/// Any such surface is right; one of little area serves best. Corners of the rim that nearly coincide are drawn
/// together by ribbons, so that the two sides of a crack cancel; what is left falls into closed curves, each with a fan
/// of triangles to its middle. Empty if the surface is closed.
Mesh closing_surface(const Mesh& mesh, const Reading& reading);

} // namespace foam::geometry
