// Meshes with fewer triangles, for a first picture and for pictures that move.
#pragma once

#include <foam/view/subject.hpp>

namespace foam::inline view {

/// Returns the mesh with the vertices of each cube of a grid merged to their mean; triangles keep their colours, and
/// those without area are left out (vertex clustering: Rossignac and Borrel, 1993). `cell`: side of a cube, m, above 0.
/// O(n) for n triangles.
ViewedMesh coarsened(const ViewedMesh& mesh, double cell);

/// Returns the cell with which meshes of this area have about `triangles` triangles, or 0 if there is no area; m.
double cell_for(double area, std::size_t triangles);

} // namespace foam::inline view
