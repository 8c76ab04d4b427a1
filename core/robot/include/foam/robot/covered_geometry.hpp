// The geometry of a robot that spheres are to cover: its collision geometry, its visual geometry, or both.
#pragma once

#include <foam/robot/robot.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] robot {

enum class CoveredGeometry { collision, visual, both };

/// Returns the words in recipes and options, in the order of the enumeration: collision, visual, both.
const std::vector<std::string>& words_of_covered_geometry();
/// Returns "collision geometry", "visual geometry" or "collision and visual geometry".
const char* to_string(CoveredGeometry geometry);

/// Returns the robot with the geometry to be covered in place of its collision geometry. An element that is both
/// collision and visual geometry occurs once. The source text stays as it is.
Robot with_covered_geometry(Robot robot, CoveredGeometry geometry);

/// Returns the names of the links that have collision geometry, but none of the kind to be covered.
std::vector<std::string> uncovered_links(const Robot& robot, CoveredGeometry geometry);

} // namespace robot
} // namespace foam
