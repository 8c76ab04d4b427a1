// What run_batch() and its workers tell each other: lines of JSON.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/batch/list.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace foam::inline batch {

/// The first argument on the command line of a worker.
inline constexpr const char* worker_command = "batch-worker";

/// The first line that a worker gets.
struct WorkerTask {
    std::int64_t parent = 0;        ///< process ID
    std::uint64_t memory_limit = 0; ///< MiB; 0: none
    std::vector<std::string> plugins;
    std::string recipe; ///< YAML
    Digest recipe_digest;
};
std::string line_of(const WorkerTask& task);
WorkerTask worker_task_of(const std::string& line);

/// The worker answers with an empty line. Each further line is an item; the answer is a line with its result.
struct Request {
    BatchItem item;
    bool one_search = false; ///< for all scales of its mesh, if the recipe allows for it
};
std::string request_line(const BatchItem& item, bool one_search);
Request request_of(const std::string& line);

/// Returns the result of a mesh that has no spheres. `code`: of the error, or "crash" or "time limit".
std::string failure_line(const BatchItem& item, const Digest& recipe, const Digest& input, const std::string& code,
                         const std::string& reason, double cpu_seconds);

} // namespace foam::batch
