// The effect of glTF extensions on triangles.
#pragma once

#include "affine.hpp"
#include "gltf_accessor.hpp"
#include "part.hpp"

#include <vector>

namespace foam::load_mesh {

/// Throws for a required extension that is not supported; warns of a used one that may affect the shape.
void check_extensions(const Source& source, const JsonPlace& root, Context& context);

/// Returns the poses of the node's mesh: `pose`, or with EXT_mesh_gpu_instancing the poses of the extension, each
/// followed by `pose`.
std::vector<Affine> instances(const JsonPlace& node, const Affine& pose, GltfAccessors& accessors);

} // namespace foam::load_mesh
