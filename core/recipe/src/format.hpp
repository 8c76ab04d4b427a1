// What the recipe format has beside the keys of keys.hpp: version, bounds, isolation, the names of its structures.
#pragma once

#include <foam/sdk/parameter.hpp>

#include <string>
#include <vector>

namespace foam::inline recipe::reading {

/// Version of the format, the value of the key `foam`.
inline constexpr int format_version = 1;
/// The renderer of snapshots when the recipe names none.
inline constexpr const char* default_renderer = "snapshot.osmesa";
/// Bounds on the width and height of pictures, in pixels.
inline constexpr int smallest_picture = 16, largest_picture = 16384;

/// Declarations of keys with a plain value. An empty default means that the key may be absent: see its doc sentence.
std::vector<Parameter> clip_values(); ///< offset, reach; of a plane, in addition to its normal
/// Returns isolate, time_limit, memory_limit: at the top level, and beside the parameters of mesh loaders, mesh filters
/// and spherizers.
std::vector<Parameter> isolation_values();
/// Returns whether a text with a unit ("10mm") is allowed as a number in metres.
bool is_length(const Parameter& parameter);
/// Returns whether the absence of a key differs from every value of it.
bool is_optional(const std::string& key);

/// Returns the keys with a list or map: robot, mesh, stages, …
std::vector<std::string> top_level_structures();

} // namespace foam::recipe::reading
