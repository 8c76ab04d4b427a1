// Changes of a recipe by path: `set`, variants, `--set`.
#pragma once

#include <foam/recipe/internal/edit.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace foam::inline recipe::reading {

struct Change {
    std::string path;
    Value value;
    Place where;        ///< of the path
    std::string remedy; ///< how to end the sweep of the same path
};

/// Reads a map from paths to values. Paths that begin with one of `fixed` are findings and are left out. `by`: "a
/// variant".
std::vector<Change> read_changes(const Value& map, std::string_view by, std::initializer_list<const char*> fixed,
                                 Findings& findings);

/// Applies the changes in their order.
void apply_changes(Value& root, const std::vector<Change>& changes, const Registry& registry, Findings& findings);

/// A named set of changes.
struct Variant {
    std::string name;
    Place where;
    std::vector<Change> changes;
};

/// Removes the key `variants` from the tree and returns its variants.
std::vector<Variant> take_variants(Value& root, Findings& findings);

} // namespace foam::recipe::reading
