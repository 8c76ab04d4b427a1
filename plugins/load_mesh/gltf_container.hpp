// The two shapes of a glTF 2.0 file: JSON text, or a GLB that holds the text and a block of bytes.
#pragma once

#include "text.hpp"

namespace foam::load_mesh {

struct GltfContainer {
    std::string_view text;
    std::string_view binary; ///< of a GLB; empty otherwise
};

/// Throws Error(input) for a GLB of another version or that breaks off.
GltfContainer open_gltf(const Source& source);

} // namespace foam::load_mesh
