// The results of one shard, as they come.
#pragma once

#include "plan.hpp"

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>

namespace foam::inline batch {

/// The file of a shard while results are added to it: FILE.part, in whole frames. One process has it at a time.
class OpenShard {
public:
    /// Opens it for writing, and goes on after its last whole line. Results of files that have changed since, and of a
    /// finished shard that is cut off, are made again. Returns nothing if the shard is finished, or if another process
    /// works on it (`busy`). Reads all files that have a result. Throws Error(output).
    static std::unique_ptr<OpenShard> open(const Plan& plan, std::size_t shard, bool& busy);
    ~OpenShard();
    OpenShard(const OpenShard&) = delete;
    OpenShard& operator=(const OpenShard&) = delete;

    /// Returns the items without a result, in the order of the work.
    const std::vector<const BatchItem*>& left() const { return left_; }
    /// Returns how many results there were when it was opened, and how many of them are failures.
    std::size_t done_before() const { return done_before_; }
    std::size_t failed_before() const { return failed_before_; }

    /// Adds the line of a result, without a line end. It is on the disk after the next flush.
    void add(std::string_view line);
    /// Writes the lines so far as a frame, if there are any.
    void flush();
    /// Returns whether lines wait longer than a few seconds for a flush.
    bool flush_due() const;
    /// Returns whether every item has its line.
    bool complete() const { return added_ == left_.size(); }
    /// Writes the rest and gives the file its final name.
    void finish();

private:
    OpenShard(int descriptor, std::filesystem::path file);
    void read_results(const Plan& plan, std::size_t shard);

    int descriptor_;
    std::filesystem::path file_; ///< the final name
    std::vector<const BatchItem*> left_;
    std::size_t done_before_ = 0, failed_before_ = 0, added_ = 0;
    std::string pending_;
    std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

/// Returns whether a process works on a shard.
bool is_worked_on(const Plan& plan, std::size_t shard);

/// Calls `on_line` for each result of a shard, finished or not. Returns whether it is finished.
bool for_each_result(const Plan& plan, std::size_t shard, const std::function<void(std::string_view)>& on_line);

} // namespace foam::batch
