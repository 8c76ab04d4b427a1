// Base64, RFC 4648.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace foam::load_mesh {

/// Decodes a text. White space and missing padding are allowed. Empty if there is another character.
std::optional<std::string> from_base64(std::string_view text);

} // namespace foam::load_mesh
