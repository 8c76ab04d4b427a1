// The version of this foam and of its libraries.
#pragma once

#include <map>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Returns the version, such as "0.1.0".
std::string version();
/// Returns the versions of the libraries that core computes with, by name; plugins report their own.
std::map<std::string, std::string> library_versions();

} // namespace runtime
} // namespace foam
