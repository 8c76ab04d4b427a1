// The check of the declarations of a plugin's stages.
#pragma once

#include <foam/sdk/registry.hpp>

#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Returns the error in a plugin's stages, alone or together with those that are registered already; empty if there is
/// none.
std::string why_bad(const std::vector<RegisteredStage>& stages, const Registry& registry);

/// Returns whether calls of such stages can run in child processes.
bool can_be_isolated(StageKind kind);

} // namespace sdk
} // namespace foam
