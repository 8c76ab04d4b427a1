// Numbers and words in texts, the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// The shortest decimal text that reads back to exactly `value`.
std::string number_text(double value);
/// The value of a text that is one decimal number ("0.1", "+2", "-1e-3") and nothing else; nothing if it is not, or if
/// the number is not finite ("nan", "inf", "1e999").
std::optional<double> parse_number(std::string_view text);
/// The pieces of a text between spaces, tabs and line ends; views into `text`.
std::vector<std::string_view> words(std::string_view text);

/// The text fit for one line of a terminal, which it cannot steer or mislead: control characters, line ends, marks that
/// turn the direction of writing, and bytes that are no UTF-8 stand as \xNN or \u{NNNN}.
std::string shown(std::string_view text);
/// The same for a text of several lines: line ends stay.
std::string shown_lines(std::string_view text);
/// Number of columns that a text takes on a terminal.
std::size_t shown_width(std::string_view text);

} // namespace foam
