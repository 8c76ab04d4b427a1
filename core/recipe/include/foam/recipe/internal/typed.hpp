// Values of a recipe, checked against declarations.
#pragma once

#include <foam/recipe/internal/yaml.hpp>
#include <foam/recipe/recipe.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// Returns `value` in the declared type, within its bounds; nothing after a finding. An integral number ("1e3") is
/// allowed as an integer, an integer as a number, and a text with a unit ("10mm") as a number of unit m. `owner`:
/// "budget", "simplify.quadric", or empty.
std::optional<ParameterValue> read_value(const Value& value, const Parameter& declared, std::string_view owner,
                                         Findings& findings);

/// Returns the declared keys of a map. Others are findings, unless they are among `other_keys`.
std::map<std::string, ParameterValue> read_values(const Value& map, const std::vector<Parameter>& declared,
                                                  std::string_view owner, const std::vector<std::string>& other_keys,
                                                  Findings& findings);

/// Adds a finding for each unknown key of the map.
void refuse_unknown_keys(const Value& map, std::string_view owner, const std::vector<std::string>& known,
                         Findings& findings);

/// Returns false after a finding if `value` does not have the expected kind. `example`: how to write it.
bool expect_map(const Value& value, std::string_view name, std::string_view example, Findings& findings);
bool expect_list(const Value& value, std::string_view name, std::string_view example, Findings& findings);

/// Reads a text, or a list of at least one text; none of them empty.
std::vector<std::string> read_texts(const Value& value, std::string_view name, Findings& findings);

} // namespace reading
} // namespace recipe
} // namespace foam
