// What tests cannot ask of a program that is built with sanitizers.
#pragma once

#include <foam/sdk/abi.hpp>

#include <string_view>

namespace foam::test {

/// Sanitizers end a process in their own way, take several times as long, and need more memory than a limit would leave.
inline constexpr bool sanitized = std::string_view(FOAM_ABI_SANITIZER) != "none";
/// The thread sanitizer runs no handler of a signal while a thread computes without a call, or waits for a connection.
inline constexpr bool signals_wait = std::string_view(FOAM_ABI_SANITIZER) == "thread";

} // namespace foam::test
