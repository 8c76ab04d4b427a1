// Lengths in text for people, and the units of meshes whose files state none.
#pragma once

#include <foam/geometry/vector.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Returns the units of lengths: mm, cm, m, in.
const std::vector<std::string>& length_units();
/// Returns the metres in one `unit`; nothing for another word.
std::optional<double> metres_in(std::string_view unit);

/// Returns the length in m of "10mm", "1 cm", "0.4in" or a plain number, which is in metres; nothing if the text is not
/// a length, or not finite.
std::optional<double> parse_length(std::string_view text);
/// Returns the accepted forms of a length, for messages: "a number in m, or one with mm, cm, m or in behind it, such as
/// 10mm".
std::string length_forms();

/// Returns a length for people, to three digits: "120 mm", "1.25 m".
std::string length_text(double metres);
/// Returns the edges of a box for people, in one unit: "80 x 80 x 120 mm".
std::string size_text(const Box& box);
/// Returns a count for people: "5,120".
std::string count_text(std::size_t count);

} // namespace geometry
} // namespace foam
