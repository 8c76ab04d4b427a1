// What kind of sphere model a YAML or JSON text is, judged by its outermost keys.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace foam::tree {

/// The outermost level of a text.
struct Outline {
    bool list = false;             ///< a list, not a map
    std::vector<std::string> keys; ///< of the map
    bool has(std::string_view key) const;
};

/// Returns the outline of the text, without checking its syntax. Linear time.
Outline outline_of(std::string_view text);

enum class Format { none, foam_json, xrdf, curobo, collision_spheres, columns, spheres_by_link, commalab };

/// Returns the format whose keys the text has.
Format format_of(std::string_view text);

} // namespace foam::tree
