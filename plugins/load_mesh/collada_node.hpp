// The transform of a COLLADA node.
#pragma once

#include "affine.hpp"
#include "collada_document.hpp"

namespace foam::load_mesh {

/// Returns the product of the node's matrix, translate, rotate, scale, lookat and skew elements, in their order: from
/// the node's frame to its parent's, in the file's unit.
Affine transform_of(const ColladaDocument& document, const xml::Element& node);

} // namespace foam::load_mesh
