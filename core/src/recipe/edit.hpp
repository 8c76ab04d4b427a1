// Changes to a recipe's tree by path, for `--set` and `sweep`.
#pragma once

#include "value.hpp"

#include <foam/host/registry.hpp>

namespace foam::reading {

/// Sets what `path` names ("budget.spheres", "stages.1.simplify.quadric.ratio", "stages.simplify.quadric.ratio"); list
/// items are counted from 0 or named by their stage. Keys may hold dots: existing keys win, then names of stages. Maps
/// that are missing on the way are made; null takes the key away. Returns why it cannot be done; empty if it is done.
std::string set_by_path(Value& root, std::string_view path, const Value& value, const Registry& registry);

/// One point of a sweep: the recipe's tree with the values of this point, and what makes its name unlike the others'.
struct SweepPoint {
    Value root;
    std::string suffix; ///< "-spheres=22"; empty without a sweep
};

/// Takes the key `sweep` out of the tree and makes all combinations, in the order of the keys, the last one fastest.
std::vector<SweepPoint> expand_sweep(Value root, const Registry& registry, Findings& findings);

} // namespace foam::reading
