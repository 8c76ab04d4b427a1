// The texts that a batch reads and writes: lines, results, messages of workers, arrays.
#pragma once

#include <foam/base/internal/digest.hpp>
#include <foam/batch/batch.hpp>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace foam::inline batch {

// Files of JSON lines, compressed as a sequence of Zstandard frames: what was cut off while a frame was written is lost
// alone.

/// Returns a frame that holds `text`. The same text gives the same bytes with the same version of libzstd.
std::string frame_of(std::string_view text);

/// Calls `on_line` for each line of whole frames, in order, without its line end. Returns the number of bytes up to the
/// end of the last whole frame. Bytes behind it that are no frame are ignored.
std::size_t for_each_line(std::string_view bytes, const std::function<void(std::string_view)>& on_line);

/// Reads a file whose frames must be whole. Throws Error(input) for one that is damaged or cut off.
void for_each_line_of(const std::filesystem::path& file, const std::function<void(std::string_view)>& on_line);

/// The first keys of a line.
struct ResultHead {
    std::string id;
    Digest digest; ///< of the file; empty if it was not read
    bool failed = false;
};

/// Returns them; reads no further. Throws Error(input) for a line that is no result.
ResultHead head_of(std::string_view line);

/// All but the spheres and their figures.
struct ResultSummary : ResultHead {
    std::string code, reason; ///< of the failure
    double cpu_seconds = 0;
};

/// Returns it. O(length of the line). Throws Error(input) for a line that is no result.
ResultSummary summary_of(std::string_view line);

/// The content of an .npz file: id (N), start (N + 1), spheres (M, 4), certified (N), excess (N). The spheres of mesh i
/// are spheres[start[i]:start[i + 1]], in metres; a mesh that failed has none.
class Arrays {
public:
    /// Adds a result.
    void add(const nlohmann::ordered_json& result);
    /// Writes the file: arrays as numpy.load() reads them. Throws Error(output).
    void write(const std::filesystem::path& file) const;

private:
    std::vector<std::string> ids_;
    std::vector<std::int64_t> starts_{0};
    std::vector<double> spheres_, excess_;
    std::vector<char> certified_;
};

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

} // namespace foam::inline batch
