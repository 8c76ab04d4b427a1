// Collision models of robots from files.
#pragma once

#include <foam/collision/self_collision.hpp>
#include <foam/judge/evaluate.hpp>

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Reads a URDF. Collision elements that are spheres are used as they are; a link with any other geometry gets at most
/// `spheres_per_link` certified covering spheres. Throws Error(input) if the file or a mesh of it cannot be read or if
/// fewer than two links have collision geometry. `package_path` as in load_original().
CollisionModel load_collision_model(const std::filesystem::path& urdf, const Registry& registry,
                                    std::size_t spheres_per_link,
                                    const std::vector<std::filesystem::path>& package_path = {});
/// Reads a URDF with the spheres of a sphere file, matched to the links as by match(). `reader` as in
/// read_sphere_file().
CollisionModel load_collision_model(const std::filesystem::path& urdf, const std::filesystem::path& spheres,
                                    const Registry& registry, const Renames& renames = {},
                                    const std::string& reader = {});

/// Returns the spheres of a model that was matched to the links of an original. Throws Error(input) if fewer than two
/// links have spheres.
CollisionModel collision_model_of(const Original& original, const MatchedModel& matched);

} // namespace judge
} // namespace foam
