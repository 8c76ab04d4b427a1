// The files and folders that a command is given.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace foam::cli {

/// Describes the argument that recipe_file() takes.
inline constexpr const char* recipe_help =
    "The recipe, a YAML file; or the name of one that comes with foam: panda_22; "
    "- is the standard input";

/// Returns the recipe's file: `name` itself, or, if that is a word and no file, the recipe of that name that comes with
/// foam. Throws Error(usage) if there is neither.
std::filesystem::path recipe_file(const std::string& name);

/// Adds `--run-dir DIR`, and its old spelling `--out`, which the help leaves out.
void add_run_directory(CLI::App& command, std::string& directory, const std::string& description);
/// Answers `-o` and `--output` of a command that writes a folder: throws Error(usage) that names `--run-dir`.
void refuse_output_file(CLI::App& command);

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
