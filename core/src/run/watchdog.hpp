// A thread that names what goes on although the run was to end.
#pragma once

#include "limits.hpp"

#include <condition_variable>
#include <mutex>
#include <thread>

namespace foam {

/// Watches a run for the life of the object. No thread where nothing could ask the run to end.
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

} // namespace foam
