// HTML pages that need no other file.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

#include <string>
#include <vector>

namespace foam::inline report {

/// Returns a page. `title` is text, `body` is HTML. The `scripts` run after the body, in their order.
std::string page(const std::string& title, const std::string& body, const std::vector<EmbeddedText>& scripts);

} // namespace foam::report
