// Text within XML, SVG and HTML, and whole pages.
#pragma once

#include <string>
#include <string_view>

namespace foam {

/// Returns the text with &, <, > and " as entities, for elements and attributes in double quotes.
std::string markup_escaped(std::string_view text);
/// Returns the bytes as text (RFC 4648), for data within a page.
std::string base64(std::string_view bytes);
/// Returns a self-contained HTML page that loads no other file: its security policy lets browsers run only foam's own
/// script. It has a light and a dark theme; the columns of <table class="sortable"> can be sorted. `title` is text,
/// `body` is HTML.
std::string html_page(const std::string& title, const std::string& body);

} // namespace foam
