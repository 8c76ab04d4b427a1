// The two forms of a glTF 2.0 file: JSON text, or a GLB with the text and a binary chunk.
#pragma once

#include "text.hpp"

namespace foam::load_mesh {

struct GltfContainer {
    std::string_view text;
    std::string_view binary; ///< of a GLB; empty otherwise
};

/// Splits a file. Throws Error(input) for a GLB that has another version or is truncated.
GltfContainer open_gltf(const Source& source);

} // namespace foam::load_mesh
