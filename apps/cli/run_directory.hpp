// The option that names the folder of a run.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace foam::cli {

/// Adds `--run-dir DIR`, and its old spelling `--out`, which the help leaves out.
void add_run_directory(CLI::App& command, std::string& directory, const std::string& description);
/// Answers `-o` and `--output` of a command that writes a folder: throws Error(usage) that names `--run-dir`.
void refuse_output_file(CLI::App& command);

} // namespace foam::cli
