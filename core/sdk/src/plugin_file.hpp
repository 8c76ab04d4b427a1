// What the registry asks of the file of a plugin before it is loaded.
#pragma once

#include <foam/sdk/plugin.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace foam::inline sdk {

/// Returns the identity of a library's build: its build ID, or a digest of the file's content if the linker wrote none;
/// empty if that file cannot be read.
std::string build_identity(const std::string& build_id, const std::filesystem::path& file);

struct ElfNote {
    std::string problem;                    ///< why the file is not a shared library for this machine; empty if it is
    std::optional<std::string> fingerprint; ///< absent: a shared library, but not a foam plugin
    std::string build_id;                   ///< that the linker wrote, hexadecimal; empty if there is none
};

/// Reads the notes with bounds checks against truncated and hostile files. Never throws because of the file's content.
ElfNote read_foam_note(const std::filesystem::path& file);

/// Returns the build ID in the notes of a segment, hexadecimal; empty if there is none.
std::string build_id_in(std::string_view notes);

/// Returns why a plugin with another fingerprint is refused, field by field.
std::string other_build(std::string_view fingerprint);

/// Returns the error in an envelope; empty if there is none. The fields after size and epoch are read only if those are
/// right.
std::string why_bad(const foam_plugin_envelope_v1* envelope);

} // namespace foam::inline sdk
