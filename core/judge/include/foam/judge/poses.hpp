// A model of a robot judged by what it does in poses of the robot.
#pragma once

#include <foam/collision/consequences.hpp>
#include <foam/judge/evaluate.hpp>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

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
