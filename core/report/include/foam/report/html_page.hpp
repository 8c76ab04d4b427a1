// Whole HTML pages.
#pragma once

#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {

/// Returns a self-contained HTML page that loads no other file: its security policy lets browsers run only foam's own
/// script. It has a light and a dark theme; the columns of <table class="sortable"> can be sorted. `title` is text,
/// `body` is HTML.
std::string html_page(const std::string& title, const std::string& body);

} // namespace report
} // namespace foam
