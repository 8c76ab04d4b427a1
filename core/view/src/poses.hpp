// Configurations with names.
#pragma once

#include <foam/view/subject.hpp>

namespace foam::inline view {

/// Returns "zero" (moved into the limits), "middle" of the limits, and the group states of an SRDF, which set the
/// joints that they name. Throws Error(input) for an SRDF that cannot be read.
std::vector<NamedPose> named_poses(const Kinematics& kinematics, const std::filesystem::path& srdf);

} // namespace foam::inline view
