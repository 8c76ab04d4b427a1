// Changes to a recipe's tree by path, for `--set` and `sweep`.
#pragma once

#include <foam/recipe/internal/yaml.hpp>
#include <foam/sdk/registry.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// Sets the value at `path` ("budget.spheres", "stages.1.simplify.quadric.ratio", "stages.simplify.quadric.ratio").
/// List items are counted from 0 or named by their stage. Keys may contain dots: existing keys come first, then names
/// of stages. Makes missing maps on the way. A null value removes the key. Returns why it is impossible; empty if it is
/// done.
std::string set_by_path(Value& root, std::string_view path, const Value& value, const Registry& registry);

/// One point of a sweep: the recipe's tree with the values of this point, and a suffix that makes its name unique.
struct SweepPoint {
    Value root;
    std::string suffix; ///< "-spheres=22"; empty without a sweep
};

/// Removes the key `sweep` from the tree and returns all combinations, in the order of the keys, the last one fastest.
std::vector<SweepPoint> expand_sweep(Value root, const Registry& registry, Findings& findings);

} // namespace reading
} // namespace recipe
} // namespace foam
