// Links without elements, for the verdict of a written file.
#pragma once

#include <foam/sdk/model.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Returns the links with collision geometry that have no elements in the model, in the order of the robot's links: the
/// recipe skips them or leaves their geometry out, or they failed.
std::vector<std::string> uncovered_links(const SphereModel& model);

} // namespace sdk
} // namespace foam
