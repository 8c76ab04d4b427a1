// Figures of a manifest as text and table cells.
#pragma once

#include <foam/base/text.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace foam::inline report {

using Json = nlohmann::ordered_json;

/// Manifests have metres, reports millimetres.
inline constexpr double mm_per_m = 1000;

/// Returns the value of a number. JSON has no infinity: the manifest has null instead.
double value_of(const Json& number);
/// Returns "12.3" or "∞".
std::string number(double value, int digits);
/// Returns HTML that shows the text in one line: no markup in it, and neither control characters nor marks of writing
/// direction (shown()).
std::string as_text(std::string_view text);
/// Returns the same for a text of several lines.
std::string as_lines(std::string_view text);
std::string escaped(const Json& text);
/// Returns a cell that sorts by its value. `html`: its content.
std::string cell(double value, const std::string& html);
std::string yes_no_cell(bool yes);
/// Marks what may differ between two runs of a recipe.
std::string execution_only(const std::string& html);
std::string section(const std::string& id, const std::string& title, const std::string& html);

} // namespace foam::report
