// Collision models, poses and pairs of links, as files have them.
#pragma once

#include <foam/collision/consequences.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/robot/robot.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Throws Error(input) for a mesh, which has no joints.
void refuse_mesh(const LoadedInput& loaded);

/// Reads a URDF. Collision elements that are spheres are used as they are; a link with any other geometry gets at most
/// `spheres_per_link` certified covering spheres. Throws Error(input) if the file or a mesh of it cannot be read or if
/// fewer than two links have collision geometry. Of the options, unit and covers do not count.
CollisionModel load_collision_model(const std::filesystem::path& urdf, const Registry& registry,
                                    std::size_t spheres_per_link, const OriginalOptions& options = {});
/// Returns the same of a robot that was read: Original::loaded. Meshes that were not kept are read. Of the options,
/// links, skip, held and geometry count.
CollisionModel collision_model_of(const std::shared_ptr<const LoadedInput>& loaded, const Registry& registry,
                                  std::size_t spheres_per_link, const OriginalOptions& options = {});

/// Returns the spheres of a model that was matched to the links of an original. Throws Error(input) if fewer than two
/// links have spheres.
CollisionModel collision_model_of(const Original& original, const MatchedModel& matched);

/// Returns the <disable_collisions> of an SRDF, the `self_collision_ignore` of a cuRobo file or the `self_collision:
/// {ignore: …}` of an XRDF; each pair once, its links and the pairs in alphabetical
/// order, with the reason that the file has. Throws Error(input) naming file, line and remedy.
std::vector<IgnoredPair> read_ignored_pairs(const std::filesystem::path& file);

/// What `foam evaluate --poses` takes.
struct PoseOptions {
    std::size_t random = 0;          ///< number of random poses
    std::filesystem::path file{};    ///< of given poses, as read_poses() takes it; empty: none
    std::filesystem::path ignored{}; ///< the pairs that are not checked, as read_ignored_pairs() takes it; empty: see
                                     ///< consequences_of()
    std::uint64_t seed = 0;
};

/// Returns the poses of a file, YAML or JSON: a list of maps from joint to position, rad or m; joints that a map does
/// not name are at zero, moved into their limits. Throws Error(input) naming file, line and what is expected.
std::vector<std::vector<double>> read_poses(const std::filesystem::path& file, const Kinematics& kinematics);

/// Returns the consequences of a model in given and random poses, the given ones first. Throws Error(input) for a file
/// that cannot be read, for a robot with fewer than two links with elements, and if no pair of links is left to check.
Consequences judged_in_poses(const Original& original, const MatchedModel& model, const PoseOptions& options);

} // namespace judge
} // namespace foam
