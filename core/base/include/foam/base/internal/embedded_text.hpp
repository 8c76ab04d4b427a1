// A text file inside a library, from cmake/EmbedText.cmake.
#pragma once

#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

struct EmbeddedText {
    std::string_view text;
    std::string_view sha256; ///< of the text, hexadecimal
};

} // namespace base
} // namespace foam
