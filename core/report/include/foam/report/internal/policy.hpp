// Security policies of pages that hold their own scripts and styles.
#pragma once

#include <foam/base/internal/embedded_text.hpp>

#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] report {

/// Returns a source of a Content Security Policy: only the text with this digest.
std::string policy_source(const EmbeddedText& text);

} // namespace report
} // namespace foam
