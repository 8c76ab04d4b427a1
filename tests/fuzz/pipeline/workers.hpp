// Cases in forked processes: what crashes or hangs is told with its seed, and the rest goes on.
#pragma once

#include "check.hpp"

#include <functional>

namespace foam::fuzz {

struct Limits {
    double cpu_seconds = 10; ///< of one case; ten times as long by the clock
    std::size_t jobs = 1;    ///< processes at once
    std::size_t batch = 100; ///< cases of one process
    CaseOptions cases;
    std::size_t memory = 0; ///< MiB of address space a process may take; 0: any
};

/// Called in the order in which cases end.
using Told = std::function<void(std::uint64_t seed, const Outcome& outcome)>;

/// Runs the cases of all seeds, each in a folder of its own below `scratch`. No thread may have been started before.
void run_cases(const std::vector<std::uint64_t>& seeds, Registry& registry, const std::filesystem::path& scratch,
               const Limits& limits, const Told& told);

} // namespace foam::fuzz
