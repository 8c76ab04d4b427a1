// Changes of a recipe by path: `set`, variants, `--set`.
#pragma once

#include "edit.hpp"

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace foam::reading {

struct Change {
    std::string path;
    Value value;
    Place where;        ///< of the path
    std::string remedy; ///< how to stop the sweep of the same path
};

/// The entries of a map of paths. Those that begin with one of `fixed` are findings and are left out. `by`: "a
/// variant".
std::vector<Change> read_changes(const Value& map, std::string_view by, std::initializer_list<const char*> fixed,
                                 Findings& findings);

/// Applies them in their order.
void apply_changes(Value& root, const std::vector<Change>& changes, const Registry& registry, Findings& findings);

/// A named set of changes.
struct Variant {
    std::string name;
    Place where;
    std::vector<Change> changes;
};

/// Takes the key `variants` out of the tree.
std::vector<Variant> take_variants(Value& root, Findings& findings);

} // namespace foam::reading
