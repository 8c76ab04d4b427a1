// Whether a plugin was built for this foam, and what it says of itself.
#pragma once

#include <foam/plugin.hpp>

#include <string>
#include <string_view>

namespace foam {

/// Why a plugin with another fingerprint is refused, field by field.
std::string other_build(std::string_view fingerprint);

/// What an envelope gets wrong; empty if nothing. The fields behind size and epoch are looked at only if those are
/// right.
std::string why_bad(const foam_plugin_envelope_v1* envelope);

} // namespace foam
