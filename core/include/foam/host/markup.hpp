// Text within XML, SVG and HTML, and whole pages.
#pragma once

#include <string>
#include <string_view>

namespace foam {

/// The text with &, <, > and " as entities, for elements and attributes in double quotes.
std::string markup_escaped(std::string_view text);
/// Bytes as text (RFC 4648), for data within a page.
std::string base64(std::string_view bytes);
/// An HTML page that needs no other file and that loads none: its security policy lets browsers run foam's own script
/// alone. In light and dark; the columns of <table class="sortable"> can be sorted. `title` is text, `body` is HTML.
std::string html_page(const std::string& title, const std::string& body);

} // namespace foam
