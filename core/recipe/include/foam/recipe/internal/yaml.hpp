// The trees of values that recipes are read from.
#pragma once

#include <foam/yaml/value.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

using namespace yaml;

} // namespace reading
} // namespace recipe
} // namespace foam
