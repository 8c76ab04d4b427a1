// Secrets in addresses.
#pragma once

#include <string>
#include <string_view>

namespace foam::inline view {

/// Returns 32 hexadecimal digits from the random numbers of the operating system. Throws Error(internal) if it has
/// none.
std::string random_token();
/// Compares in a time that does not depend on where the texts differ.
bool same_secret(std::string_view a, std::string_view b);

} // namespace foam::inline view
