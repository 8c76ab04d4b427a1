// Pairs of links that other tools' files leave out of self-collision checks.
#pragma once

#include <foam/robot/robot.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] judge {

/// Returns the <disable_collisions> of an SRDF, the `self_collision_ignore` of a cuRobo file or the `self_collision:
/// {ignore: …}` of an XRDF; each pair once, its links and the pairs in alphabetical
/// order, with the reason that the file has. Throws Error(input) naming file, line and remedy.
std::vector<IgnoredPair> read_ignored_pairs(const std::filesystem::path& file);

} // namespace judge
} // namespace foam
