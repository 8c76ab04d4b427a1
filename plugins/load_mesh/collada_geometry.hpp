// The faces of a COLLADA geometry.
#pragma once

#include "collada_document.hpp"
#include "part.hpp"

namespace foam::load_mesh {

/// Triangles, polygons, strips and fans of a <geometry>, in its frame and unit; lines are left out. What is left out
/// although it is a surface (splines, holes) or only looks wrong is logged.
Part read_geometry(const ColladaDocument& document, const xml::Element& geometry, Context& context);

} // namespace foam::load_mesh
