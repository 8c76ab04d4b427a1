// Which build of a plugin, and of foam's libraries, runs.
#pragma once

#include <filesystem>
#include <string>

namespace foam::inline sdk {

/// Returns the identity of a library's build: its build ID, or a digest of the file's content if the linker wrote none;
/// empty if that file cannot be read.
std::string build_identity(const std::string& build_id, const std::filesystem::path& file);

} // namespace foam::sdk
