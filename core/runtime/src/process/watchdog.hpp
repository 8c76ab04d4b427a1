// A thread that reports work that continues although the run should have ended.
#pragma once

#include <foam/runtime/internal/limits.hpp>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace foam::inline runtime {

/// Watches a run during its lifetime. Starts no thread if nothing can request the end of the run.
class Watchdog {
public:
    Watchdog(const Limits& limits, const RunOptions& options, Journal& journal);
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

private:
    void watch();
    void bark(const Limits::Due& due);

    const Limits& limits_;
    const RunOptions& options_;
    Journal& journal_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool done_ = false;
    std::thread thread_;
};

} // namespace foam::runtime
