// Robots and meshes that are read to judge models by them.
#pragma once

#include <foam/judge/evaluate.hpp>
#include <foam/runtime/internal/reading.hpp>

namespace foam::inline judge {

/// Reads a URDF, or a mesh, without the meshes of a robot. Errors as load_original().
std::shared_ptr<const LoadedInput> read_original(const std::filesystem::path& file, const Registry& registry,
                                                 const OriginalOptions& options = {});

} // namespace foam::inline judge
