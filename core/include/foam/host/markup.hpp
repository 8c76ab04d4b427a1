// Text within XML, SVG and HTML.
#pragma once

#include <string>
#include <string_view>

namespace foam {

/// The text with &, <, > and " as entities, for elements and attributes in double quotes.
std::string markup_escaped(std::string_view text);

} // namespace foam
