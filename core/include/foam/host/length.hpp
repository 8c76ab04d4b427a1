// Lengths as people write them, and the units that meshes without one may be in.
#pragma once

#include <foam/vector.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace foam {

/// The units that lengths may be written in: mm, cm, m, in.
const std::vector<std::string>& length_units();
/// Metres in one `unit`; nothing for another word.
std::optional<double> metres_in(std::string_view unit);

/// m: of "10mm", "1 cm", "0.4in" or a plain number, which is in metres; nothing if it is none, or not finite.
std::optional<double> parse_length(std::string_view text);
/// What a length may be, for messages: "a number in m, or one with mm, cm, m or in behind it, such as 10mm".
std::string length_forms();

/// A length for people, to three digits: "120 mm", "1.25 m".
std::string length_text(double metres);
/// The edges of a box for people, in one unit: "80 x 80 x 120 mm".
std::string size_text(const Box& box);
/// A count for people: "5,120".
std::string count_text(std::size_t count);

} // namespace foam
