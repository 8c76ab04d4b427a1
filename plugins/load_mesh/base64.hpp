// Bytes written as text, RFC 4648.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace foam::load_mesh {

/// White space and missing padding are tolerated; empty if another character is in it.
std::optional<std::string> from_base64(std::string_view text);

} // namespace foam::load_mesh
