// What this foam is, and what it is made of.
#pragma once

#include <map>
#include <string>

namespace foam {

/// "0.1.0"
std::string version();
/// Versions of the libraries that core computes with, by name; those of the plugins are the plugins' own.
std::map<std::string, std::string> library_versions();

} // namespace foam
