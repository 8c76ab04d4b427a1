// Names as globs; foam/recipe/recipe.hpp matches them.
#pragma once

#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// Returns the glob that matches this name alone.
std::string glob_of_name(const std::string& name);

} // namespace recipe
} // namespace foam
