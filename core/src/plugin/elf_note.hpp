// Reads a plugin's fingerprint from its file, without running its code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace foam {

struct ElfNote {
    std::string problem;                    ///< why the file is not a shared library for this machine; empty if it is
    std::optional<std::string> fingerprint; ///< absent: a shared library, but not a foam plugin
};

/// Reads the note with bounds checks against truncated and hostile files. Never throws because of the file's content.
ElfNote read_foam_note(const std::filesystem::path& file);

} // namespace foam
