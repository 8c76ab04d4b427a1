// A library that a plugin opens on first use, because the libraries that it needs would slow down every start of foam.
#pragma once

#include <filesystem>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] sdk {

/// Where a late library lies, and what is wanted of it.
struct LateLibrary {
    const char* stage; ///< named in errors
    const char* file;  ///< relative to the plugin's folder
    const char* entry; ///< the name of an extern "C" function
    const char* cure;  ///< what to do where it cannot be opened
};

/// Opens the library beside the plugin that holds `own_function`, and returns the address of its entry. It stays open until
/// the process ends: libraries leave threads and exit handlers behind. Throws Error(plugin) where there is no such file, or a
/// library that it needs is missing; Error(internal) where the plugin's file is not known.
void* open_late_library(const LateLibrary& library, const void* own_function);

} // namespace sdk
} // namespace foam
