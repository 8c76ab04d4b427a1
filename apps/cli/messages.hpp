// How what the program prints is shown: in colour, and with a name for the standard input.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foam::cli {

/// The words of `--color`.
enum class Colour { automatic, always, never };

/// Chooses colours. Automatic: on a terminal, unless NO_COLOR is set or TERM is "dumb".
void choose_colours(Colour colour);
/// Shows "stdin" in the place of these names.
void show_as_standard_input(std::vector<std::string> names);

/// Returns the text with "stdin" for the names of show_as_standard_input().
std::string with_names(std::string text);
enum class Stream { out, err };
/// Returns a text for people as the stream shows it: errors and statements that do not hold red, warnings yellow,
/// statements that hold green.
std::string coloured(const std::string& text, Stream stream);

} // namespace foam::cli
