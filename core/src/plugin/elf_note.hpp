// Reads a plugin's fingerprint from its file, without running any of it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace foam {

struct ElfNote {
    std::string problem;                    ///< why the file is no shared library of this machine; empty if it is
    std::optional<std::string> fingerprint; ///< absent: a shared library, but not a foam plugin
};

/// Bounds-checked against truncated and hostile files; never throws for what the file holds.
ElfNote read_foam_note(const std::filesystem::path& file);

} // namespace foam
