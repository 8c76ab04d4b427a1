// From what assimp makes of a format's axes and units to foam's: the axes of the file, metres where the file says its
// unit.
#pragma once

#include "affine.hpp"

#include <assimp/scene.h>

#include <span>
#include <string_view>

namespace foam::load_assimp {

/// The map from the frame of the scene's root to the mesh. `ending`: of the file, lower case.
Affine frame_of(const aiScene& scene, std::string_view ending);

/// What to tell of the unit of such files; empty: nothing.
std::string_view unit_note(std::string_view ending);

/// Endings of formats that say their unit to assimp, so that the mesh is in metres.
std::span<const std::string_view> endings_with_unit();

} // namespace foam::load_assimp
