// Texts that are almost XML, as the field writes them.
#pragma once

#include <foam/xml/document.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace foam::xml {

/// Stands for a '&' that begins no entity, which expat refuses; in texts that have no such character themselves.
constexpr char bare_ampersand = '\x7F';

/// A text of as many bytes that expat reads: no place and no line moves.
struct Mended {
    std::string text;
    std::vector<Fault> faults;
    const char* encoding = nullptr;   ///< in place of the one that the text declares
    bool has_bare_ampersands = false; ///< bare_ampersand stands for them
};

/// Mends what stands before an XML declaration, comments with "--" in them, '&' that begin no entity, and encodings
/// that expat does not know.
Mended mended(std::string_view text);

} // namespace foam::xml
