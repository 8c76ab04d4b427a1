// The conversion from assimp's axes and units to foam's: the axes of the file, and metres if the file has a unit.
#pragma once

#include "affine.hpp"

#include <assimp/scene.h>

#include <span>
#include <string_view>

namespace foam::load_assimp {

/// Returns the map from the frame of the scene's root to the mesh. `ending`: of the file, lower case.
Affine frame_of(const aiScene& scene, std::string_view ending);

/// Returns a note on the unit of such files; empty: none.
std::string_view unit_note(std::string_view ending);

/// Returns the extensions of formats whose unit assimp reads, so that the mesh is in metres.
std::span<const std::string_view> endings_with_unit();

} // namespace foam::load_assimp
