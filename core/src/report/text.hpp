// Figures of a manifest as text and table cells.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace foam::report {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: a null of the manifest is one.
double value_of(const Json& number);
/// "12.3"; "∞".
std::string number(double value, int digits);
std::string escaped(const Json& text);
/// A cell that sorts by its value. `html`: what it shows.
std::string cell(double value, const std::string& html);
std::string yes_no_cell(bool yes);
/// "1 link", "3 links".
std::string counted(std::size_t count, const std::string& noun);
/// What may differ between two runs of a recipe.
std::string execution_only(const std::string& html);
std::string section(const std::string& id, const std::string& title, const std::string& html);

} // namespace foam::report
