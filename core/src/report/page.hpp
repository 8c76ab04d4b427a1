// HTML pages that need no other file.
#pragma once

#include "data/embedded_text.hpp"

#include <string>
#include <vector>

namespace foam::report {

/// `title` is text, `body` is HTML; `scripts` run after it, in their order.
std::string page(const std::string& title, const std::string& body, const std::vector<embedded::Text>& scripts);

} // namespace foam::report
