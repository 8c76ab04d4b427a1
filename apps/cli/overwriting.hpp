// Outputs that would take the place of what they are made from.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <vector>

namespace foam::cli {

/// Returns whether two paths lead to one file that exists.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);
/// `--force`.
void add_force(CLI::App& command, bool& force);
/// Throws Error(usage) if `target` is one of the inputs, by whatever name or link, unless `force`. Empty paths and
/// files that do not exist are none.
void refuse_overwriting(const std::filesystem::path& target, const std::vector<std::filesystem::path>& inputs,
                        bool force);
/// The same for a folder that is replaced as a whole: none of the inputs may lie within it.
void refuse_replacing(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs,
                      bool force);

} // namespace foam::cli
