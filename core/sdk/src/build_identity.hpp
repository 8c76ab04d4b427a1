// Which build of a plugin, and of foam's libraries, runs.
#pragma once

#include <filesystem>
#include <string>

namespace foam::inline sdk {

/// Returns the identity of a library's build: the build ID that the linker wrote into it, else a digest of its content;
/// empty if the file cannot be read.
std::string build_identity(const std::filesystem::path& file);

} // namespace foam::sdk
