// Two links with a mesh each, and recipes for them.
#pragma once

#include <foam/sdk/abi.hpp>

#include <string_view>

namespace foam::test {

inline constexpr const char* two_links_urdf =
    "<robot name=\"two\">\n"
    "  <link name=\"base\"><collision><geometry><mesh filename=\"box.obj\"/></geometry></collision></link>\n"
    "  <link name=\"tip\"><collision><geometry><mesh filename=\"box.obj\" scale=\"1 2 "
    "1\"/></geometry></collision></link>\n"
    "  <joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"tip\"/></joint>\n"
    "</robot>\n";

/// Sanitizers end a process in their own way, and need more memory than a limit would leave.
inline constexpr bool sanitized = std::string_view(FOAM_ABI_SANITIZER) != "none";

} // namespace foam::test
