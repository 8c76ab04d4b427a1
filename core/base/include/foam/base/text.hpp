// Text for people: numbers, names, lengths; and text in HTML and XML.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Returns the shortest decimal text that reads back to exactly `value`.
std::string number_text(double value);
/// Returns the value of a text that is one decimal number ("0.1", "+2", "-1e-3") and nothing else; nothing if it is
/// not, or if the number is not finite ("nan", "inf", "1e999").
std::optional<double> parse_number(std::string_view text);
/// Returns a number with its noun: "1 pair", "2 pairs", "3 meshes". `noun`: in the singular, regular.
std::string counted(std::size_t count, std::string_view noun);
/// Returns the first three names, and how many more there are: "a, b, c and 2 more".
std::string first_names(const std::vector<std::string>& names);
/// Returns a noun behind its article: "a box", "an ellipsoid".
std::string with_article(std::string_view noun);
/// Returns the text with the letters A to Z in lower case; other characters stay.
std::string lower_case(std::string_view text);
/// Returns the text with its percent escapes decoded (RFC 3986, section 2.1). Invalid escapes and %00 stay.
std::string percent_decoded(std::string_view text);
/// Returns the parts of a text between spaces, tabs and line ends, as views into `text`.
std::vector<std::string_view> words(std::string_view text);

/// Returns the text fit for one line of a terminal, so that it can neither steer nor mislead it: control characters,
/// line ends, marks that change the direction of writing, and bytes that are not UTF-8 appear as \xNN or \u{NNNN}.
std::string shown(std::string_view text);
/// Returns the same for a text of several lines: line ends stay.
std::string shown_lines(std::string_view text);
/// Returns the number of columns that a text occupies on a terminal.
std::size_t shown_width(std::string_view text);

/// Returns the smallest number of insertions, deletions, substitutions and swaps of neighbours between two words.
std::size_t edit_distance(std::string_view a, std::string_view b);
/// Returns the candidate nearest to `word` if it is near enough to be a typing error; else empty.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// Returns the text with &, <, > and " as entities, for elements and attributes in double quotes.
std::string markup_escaped(std::string_view text);
/// Returns the same for an attribute whose line ends and tabs are kept: parsers turn them into spaces (XML 1.0, 3.3.3).
std::string attribute_escaped(std::string_view text);
/// Returns the bytes as text (RFC 4648), for data within a page.
std::string base64(std::string_view bytes);

} // namespace base
} // namespace foam
