// Digests of robots and of calls of stages; see foam/base/internal/digest.hpp.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/geometry/internal/digest.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/robot/robot.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Adds links, their collision elements and joints; not the places of files, nor visual geometry.
void add_to(Hasher& hasher, const Robot& robot);
/// Adds what determines the effect of a stage: its name, its build and that of foam's libraries, its revision, and all
/// parameters that affect its output, defaults included.
void add_call(Hasher& hasher, const StageCall& call, const Registry& registry);

} // namespace runtime
} // namespace foam
