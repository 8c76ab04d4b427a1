// The time and memory of another run of foam.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace foam::inline bench::experiment {

/// A finished process.
struct MeasuredProgram {
    double cpu_seconds = 0;    ///< user and system
    double memory = 0;         ///< bytes; the most that was resident
    int exit_code = 0;
    bool over_limit = false;   ///< it was ended
    std::string output;        ///< what it wrote to stdout
    std::string errors;        ///< and to stderr
};

/// Returns the program `foam` of this installation. Throws Error(usage) if it is not there.
std::filesystem::path foam_program();

/// Runs a program to its end and measures it. `cpu_limit`: s. Throws Error(internal) if it cannot be started.
MeasuredProgram run_measured(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                             double cpu_limit, const std::filesystem::path& scratch);

} // namespace foam::bench::experiment
