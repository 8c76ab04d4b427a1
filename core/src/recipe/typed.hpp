// Values of a recipe, checked against declarations.
#pragma once

#include "value.hpp"

#include <foam/host/recipe.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam::reading {

/// `value` as the declared type, within its bounds; nothing after a finding. An integral number ("1e3") is an integer
/// where one is wanted, an integer is a number where one is wanted, and a number of unit m may be a text with another
/// unit
/// ("10mm"). `owner`: "budget", "simplify.quadric", or empty.
std::optional<ParameterValue> read_value(const Value& value, const Parameter& declared, std::string_view owner,
                                         Findings& findings);

/// The declared keys of a map. Others are findings, unless they are among `other_keys`.
std::map<std::string, ParameterValue> read_values(const Value& map, const std::vector<Parameter>& declared,
                                                  std::string_view owner, const std::vector<std::string>& other_keys,
                                                  Findings& findings);

/// A finding for each key of the map that is not known.
void refuse_unknown_keys(const Value& map, std::string_view owner, const std::vector<std::string>& known,
                         Findings& findings);

/// False after a finding if `value` is not of that kind. `example`: how to write it.
bool expect_map(const Value& value, std::string_view name, std::string_view example, Findings& findings);
bool expect_list(const Value& value, std::string_view name, std::string_view example, Findings& findings);

/// A text, or a list of at least one text; none of them empty.
std::vector<std::string> read_texts(const Value& value, std::string_view name, Findings& findings);

} // namespace foam::reading
