// What extensions of glTF mean for its triangles.
#pragma once

#include "affine.hpp"
#include "gltf_accessor.hpp"
#include "part.hpp"

#include <vector>

namespace foam::load_mesh {

/// Throws for a required extension that is not read; warns of a used one that may belong to the shape.
void check_extensions(const Source& source, const JsonPlace& root, Context& context);

/// Where the node shows its mesh: at `pose`, or with EXT_mesh_gpu_instancing at the poses that it lists, each followed
/// by `pose`.
std::vector<Affine> instances(const JsonPlace& node, const Affine& pose, GltfAccessors& accessors);

} // namespace foam::load_mesh
