// Reads the notes of a plugin's file, without running its code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam::inline sdk {

struct ElfNote {
    std::string problem;                    ///< why the file is not a shared library for this machine; empty if it is
    std::optional<std::string> fingerprint; ///< absent: a shared library, but not a foam plugin
    std::string build_id;                   ///< that the linker wrote, hexadecimal; empty if there is none
};

/// Reads the notes with bounds checks against truncated and hostile files. Never throws because of the file's content.
ElfNote read_foam_note(const std::filesystem::path& file);

/// Returns the build ID in the notes of a segment, hexadecimal; empty if there is none.
std::string build_id_in(std::string_view notes);

} // namespace foam::sdk
