// What plugins say of their stages, checked.
#pragma once

#include <foam/host/registry.hpp>

#include <string>
#include <vector>

namespace foam {

/// What the stages of a plugin get wrong, on their own or beside those that are registered already; empty if nothing.
std::string why_bad(const std::vector<RegisteredStage>& stages, const Registry& registry);

/// Whether the calls of such stages can run in child processes.
bool can_be_isolated(StageKind kind);

} // namespace foam
