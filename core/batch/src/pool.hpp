// Worker processes that live on for many meshes.
#pragma once

#include "messages.hpp"

#include <foam/runtime/internal/child.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam::inline batch {

/// Limits of a worker, and what it is started with.
struct PoolOptions {
    std::filesystem::path program;
    WorkerTask task;
    double time_limit = 60; ///< s; of one mesh
    std::size_t workers = 1;
};

/// Meshes that one worker gets one after the other: the scales of one mesh.
struct Job {
    std::vector<const BatchItem*> items;
    std::size_t owner = 0;   ///< of the caller
    bool one_search = false; ///< for all of them
    std::size_t at = 0;      ///< the item that is worked on
    bool again = false;      ///< a worker has ended with that item

    const BatchItem& item() const { return *items[at]; }
};

/// A few workers. They are started when they are needed, and replaced after a crash or a limit.
class Pool {
public:
    explicit Pool(PoolOptions options);

    /// Gives jobs to workers that are free, as long as `next` returns any, and waits for answers for at most 50 ms.
    /// Calls `done` for each mesh, job.item(), with its line. Throws Error(internal) if no worker can be started.
    using Done = std::function<void(const Job& job, const std::string& line)>;
    void turn(const std::function<std::optional<Job>()>& next, const Done& done);
    /// Returns whether no worker has a mesh.
    bool idle() const;

private:
    using Clock = std::chrono::steady_clock;

    /// One worker.
    struct Worker {
        explicit Worker(const PoolOptions& options);
        void give(Job next);
        /// Reads what has come.
        void receive();
        /// Returns the next complete line, if there is one.
        std::optional<std::string> line();
        /// Returns the first line that it wrote to stderr about its end.
        std::string last_words() const;

        Pipe requests, answers;
        Descriptor errors;
        std::unique_ptr<ChildProcess> process;
        std::optional<Job> job;
        bool ready = false; ///< it has reported so
        Clock::time_point since;
        std::string received;
    };

    void wait();
    void read_answers(std::unique_ptr<Worker>& worker, const Done& done);
    void take_line(Worker& worker, const std::string& line, const Done& done);
    void end_of(std::unique_ptr<Worker>& worker, const Done& done);
    /// Calls `done` for the item of the job, and keeps the items behind it for another worker.
    void finish_item(Job job, const std::string& line, const Done& done);

    PoolOptions options_;
    std::vector<std::unique_ptr<Worker>> workers_;
    std::vector<Job> waiting_; ///< whose worker has ended
};

} // namespace foam::batch
