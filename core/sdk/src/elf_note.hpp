// Reads the notes of a plugin's file, without running its code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace foam::inline sdk {

struct ElfNote {
    std::string problem;                    ///< why the file is not a shared library for this machine; empty if it is
    std::optional<std::string> fingerprint; ///< absent: a shared library, but not a foam plugin
};

/// Reads the note with bounds checks against truncated and hostile files. Never throws because of the file's content.
ElfNote read_foam_note(const std::filesystem::path& file);

/// Returns the build ID that the linker wrote into the file, hexadecimal; empty if it has none. Never throws because of
/// the file's content.
std::string read_build_id(const std::filesystem::path& file);

} // namespace foam::sdk
