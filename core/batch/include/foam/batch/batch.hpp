// Spheres for data sets: many meshes by one recipe, in shards, with workers that live on.
#pragma once

#include <foam/recipe/mesh_unit.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] batch {

/// One mesh of a data set.
struct BatchItem {
    std::string id;   ///< unique in the list
    std::string path; ///< absolute; "FILE.zip::MEMBER" and "FILE.tar::MEMBER" lie in archives
    MeshUnit unit;
    std::optional<std::size_t> spheres; ///< instead of the recipe's budget
    std::uintmax_t bytes = 0;           ///< size of the file; 0: not known, or there is no such file
};

/// Returns the meshes of a data set, sorted by id; `bytes` is 0. `source` is one of
/// - a list: JSON lines (.jsonl) with the keys id, path, scale, unit and spheres; a table (.csv) with these columns in
///   its first line; or a text (.txt) with one path a line. Only `path` is required; the id is the path otherwise.
///   Paths are relative to the list's folder;
/// - a folder or an archive (.zip, .tar): all its files that a loader of the registry reads; ids are their paths in it.
///   Links are followed, but to a folder that contains the link;
/// - a glob ("meshes/*.obj"), in which * and ? stay within a folder;
/// - "-": JSON lines from the standard input, with paths relative to the current folder.
/// Throws Error(input) that names the file and line, also for an id that occurs twice and for an empty list.
std::vector<BatchItem> read_batch_list(const std::string& source, const Registry& registry);

/// How far the work of this process is.
struct BatchProgress {
    std::size_t meshes = 0; ///< of all shards of this process
    std::size_t done = 0;   ///< of these, with those that had a result before
    std::size_t failed = 0; ///< of those that are done
    double rate = 0;        ///< meshes a second in this process; 0: not known yet
};

struct BatchOptions {
    std::filesystem::path folder;      ///< of the results; made if it is missing
    std::optional<std::size_t> shards; ///< absent: as in the folder, or one for every thousand meshes
    std::vector<std::size_t> only;     ///< the shards of this process; empty: those of `tasks`
    /// Returns the shards of this process, given the number of all; absent: all. May be none.
    std::function<std::vector<std::size_t>(std::size_t shards)> tasks;
    std::size_t workers = 0; ///< processes; 0: one a core
    double time_limit = 60;  ///< s; of one mesh
    /// MiB; of one worker; 0: none. Absent: 4096, and none in a foam built with a sanitizer, which cannot enforce one.
    std::optional<std::size_t> memory_limit;
    std::filesystem::path program;                      ///< its main() calls serve_batch_worker(); empty: this program
    std::function<bool()> stop;                         ///< asked about twenty times a second; empty: never
    std::function<void(const BatchProgress&)> progress; ///< called a few times a second
};

/// The state of a folder of results.
struct BatchStatus {
    std::size_t meshes = 0, done = 0, failed = 0;
    std::size_t shards = 0, finished_shards = 0, worked_on = 0; ///< worked_on: shards that a process has now
    std::map<std::string, std::size_t> reasons; ///< failures by code and reason, without names and numbers
    double cpu_seconds = 0;                     ///< of the meshes that are done
    /// Returns the meshes that one core does in a second, by the mean of those that are done; 0: not known yet.
    double rate_of_core() const;
    /// Returns the CPU time that the other meshes need, s, if they take as long as those that are done.
    double cpu_seconds_left() const;
};

/// The result of run_batch().
struct BatchOutcome {
    bool complete = false; ///< every shard of the folder is finished, by this process or others
    std::size_t added = 0; ///< results that this process made
    std::size_t busy = 0;  ///< shards left out, as another process works on them
    bool stopped = false;  ///< by `stop`; all results so far are kept
    std::size_t meshes = 0, failed = 0, missing = 0; ///< of the shards of this process
};

/// Turns each mesh of the list into spheres by the recipe, whose own mesh, outputs and snapshots play no part. A mesh
/// that fails, crashes its worker twice or exceeds a limit is a failure with a reason. Results that are there already
/// stay. The results are the same for any number of workers, shards and restarts, but for times and limits. Throws
/// Error if the folder cannot be used.
BatchOutcome run_batch(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
                       const BatchOptions& options);

/// Makes the folder without working on it, and writes the scripts that do: foam.sbatch (Slurm), Snakefile and
/// README.md. `command`: the command line that makes the folder, without --slurm and --shard, each argument by itself.
void prepare_batch(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
                   const BatchOptions& options, const std::vector<std::string>& command);

/// Returns the state of a folder of results.
BatchStatus batch_status(const std::filesystem::path& folder);

struct CollectOptions {
    bool failures = false; ///< only these
    bool times = true;     ///< false: without cpu_seconds, so that equal work gives equal bytes
};

/// The numbers of a table.
struct Collected {
    std::size_t lines = 0, failed = 0, duplicates = 0, missing = 0; ///< duplicates: of the bytes of another mesh
};

/// Writes the results of a folder into one table, sorted by id: JSON lines, compressed if the name ends in .zst, or
/// arrays of NumPy if it ends in .npz. An empty path: the standard output. Throws Error.
Collected collect_batch(const std::filesystem::path& folder, const std::filesystem::path& table,
                        const CollectOptions& options);

/// Returns the text of a table of JSON lines, .jsonl or compressed as .jsonl.zst. Throws Error(input).
std::string read_batch_table(const std::filesystem::path& table);

/// Writes index.html into the folder: figures and pictures of the first thousand meshes.
void write_batch_page(const std::filesystem::path& folder);

/// Serves run_batch() and never returns, if the command line says that this process was started for that; otherwise
/// does nothing. It must be among the first statements of main() of a program that calls run_batch().
void serve_batch_worker(int count, char** arguments);

} // namespace batch
} // namespace foam
