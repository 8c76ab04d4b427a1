// The sections of the report, and the text in them.
#pragma once

#include <foam/base/internal/embedded_text.hpp>
#include <foam/base/text.hpp>
#include <foam/report/internal/report.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Returns a page. `title` is text, `body` is HTML. The `scripts` run after the body, in their order.
std::string page(const std::string& title, const std::string& body, const std::vector<EmbeddedText>& scripts);

std::string header_section(const Report& report);    ///< name and what is proved
std::string summary_section(const Report& report);   ///< figures of the whole model
std::string viewer_section(const Report& report);    ///< 3-D view and its controls
std::string links_section(const Report& report);     ///< table of figures
std::string radii_section(const Report& report);     ///< histogram
std::string stages_section(const Report& report);    ///< each link after each stage
std::string proof_section(const Report& report);     ///< the certificate
std::string findings_section(const Report& report);  ///< findings of stages
std::string recipe_section(const Report& report);    ///< as run
std::string files_section(const Report& report);     ///< inputs, outputs, versions
std::string reproduce_section(const Report& report); ///< commands
std::string execution_section(const Report& report); ///< times

std::string guarantee_of(const Report& report);
bool certified(const Report& report);
/// Returns whether some links have elements that are no spheres.
bool has_other_elements(const Report& report);
/// Returns the verdict as HTML.
std::string verdict(const Report& report);
/// Returns "collision geometry", or the other geometry that is covered.
std::string covered_geometry(const Report& report);
/// Returns the links that the proof leaves out, as HTML; empty if there are none.
std::string omissions(const Report& report);
/// Returns the class of the verdict's element.
std::string verdict_class(const Report& report);

} // namespace foam::inline report
