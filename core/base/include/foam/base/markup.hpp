// Text within XML, SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Returns the text with &, <, > and " as entities, for elements and attributes in double quotes.
std::string markup_escaped(std::string_view text);
/// Returns the same for an attribute whose line ends and tabs are kept: parsers turn them into spaces (XML 1.0, 3.3.3).
std::string attribute_escaped(std::string_view text);
/// Returns the bytes as text (RFC 4648), for data within a page.
std::string base64(std::string_view bytes);

} // namespace base
} // namespace foam
