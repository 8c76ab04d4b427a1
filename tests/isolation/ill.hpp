// Two links with a mesh each, and recipes for them.
#pragma once

#include "support/sanitizers.hpp"

namespace foam::test {

inline constexpr const char* two_links_urdf =
    "<robot name=\"two\">\n"
    "  <link name=\"base\"><collision><geometry><mesh filename=\"box.obj\"/></geometry></collision></link>\n"
    "  <link name=\"tip\"><collision><geometry><mesh filename=\"box.obj\" scale=\"1 2 "
    "1\"/></geometry></collision></link>\n"
    "  <joint name=\"j\" type=\"fixed\"><parent link=\"base\"/><child link=\"tip\"/></joint>\n"
    "</robot>\n";

} // namespace foam::test
