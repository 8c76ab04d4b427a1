// The faces of a COLLADA geometry.
#pragma once

#include "collada_document.hpp"
#include "part.hpp"

namespace foam::load_mesh {

/// A <geometry>: its part, and the names by which its materials are bound where it is shown.
struct ColladaGeometry {
    Part part;
    std::vector<std::string> materials; ///< Part::materials are indices into them
};

/// Returns the triangles, polygons, strips and fans of a <geometry>, in its frame and unit, without lines. Logs
/// surfaces that are left out (splines, holes) and suspicious contents.
ColladaGeometry read_geometry(const ColladaDocument& document, const xml::Element& geometry, Context& context);

} // namespace foam::load_mesh
