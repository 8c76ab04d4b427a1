// Reading whole files that may be anything.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace foam {

/// What a file holds, or why it was not read.
struct FileContents {
    std::string bytes;
    std::string problem; ///< "there is no such file"; empty if it was read
    std::string remedy;  ///< "check the path"
    /// "there is no such file; remedy: check the path"; empty if it was read.
    std::string why_not() const { return problem.empty() ? "" : problem + "; remedy: " + remedy; }
};

/// Reads a regular file of at most `most_bytes`: its size is asked before any of it is read. Folders, pipes and devices
/// are refused, not waited for, and so is a file that changes its size meanwhile. `if_too_large`: the remedy then.
FileContents read_regular_file(const std::filesystem::path& file, std::uintmax_t most_bytes,
                               std::string_view if_too_large);

} // namespace foam
