// The plan of a call of run_batch().
#pragma once

#include "plan.hpp"

#include <foam/batch/batch.hpp>

namespace foam::inline batch {

inline constexpr std::size_t default_memory_limit = 4096; ///< MiB; of one worker

/// Opens or makes the plan. Throws Error(usage) for the recipe of a robot, and for one whose stage makes other
/// elements than spheres.
Plan plan_for(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options);

/// Returns the recipe as workers get it: YAML with absolute paths.
std::string worker_recipe(const Recipe& recipe, const Registry& registry);

} // namespace foam::batch
