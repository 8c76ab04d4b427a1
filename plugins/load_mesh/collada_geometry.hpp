// The faces of a COLLADA geometry.
#pragma once

#include "collada_document.hpp"
#include "part.hpp"

namespace foam::load_mesh {

/// Returns the triangles, polygons, strips and fans of a <geometry>, in its frame and unit, without lines. Logs
/// surfaces that are left out (splines, holes) and suspicious contents.
Part read_geometry(const ColladaDocument& document, const xml::Element& geometry, Context& context);

} // namespace foam::load_mesh
