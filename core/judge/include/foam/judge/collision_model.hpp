// Collision models of robots from files.
#pragma once

#include <foam/collision/self_collision.hpp>
#include <foam/judge/evaluate.hpp>

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Throws Error(input) for a mesh, which has no joints.
void refuse_mesh(const LoadedInput& loaded);

/// Reads a URDF. Collision elements that are spheres are used as they are; a link with any other geometry gets at most
/// `spheres_per_link` certified covering spheres. Throws Error(input) if the file or a mesh of it cannot be read or if
/// fewer than two links have collision geometry. Of the options, package_path and name count.
CollisionModel load_collision_model(const std::filesystem::path& urdf, const Registry& registry,
                                    std::size_t spheres_per_link, const OriginalOptions& options = {});
/// Returns the same of a robot that was read: Original::loaded. Meshes that were not kept are read.
CollisionModel collision_model_of(const std::shared_ptr<const LoadedInput>& loaded, const Registry& registry,
                                  std::size_t spheres_per_link);

/// Returns the spheres of a model that was matched to the links of an original. Throws Error(input) if fewer than two
/// links have spheres.
CollisionModel collision_model_of(const Original& original, const MatchedModel& matched);

} // namespace judge
} // namespace foam
