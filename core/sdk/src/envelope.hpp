// The check that a plugin was built for this foam, and of its metadata.
#pragma once

#include <foam/sdk/plugin.hpp>

#include <string>
#include <string_view>

namespace foam::inline sdk {

/// Returns why a plugin with another fingerprint is refused, field by field.
std::string other_build(std::string_view fingerprint);

/// Returns the error in an envelope; empty if there is none. The fields after size and epoch are read only if those are
/// right.
std::string why_bad(const foam_plugin_envelope_v1* envelope);

} // namespace foam::sdk
