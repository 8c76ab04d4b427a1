#include "handover.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/base/parallel.hpp>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <mutex>

namespace foam::inline base {

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    std::mutex mutex;
    std::exception_ptr first;
    std::size_t first_index = count;
    const ThreadWork shared = current_work();
    std::atomic<bool> ended = false; // exceptions of a million bodies would take seconds
    Handover work, results;
    work.give();
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
            work.take();
            const ActivityLoan loan(shared);
            for (std::size_t i = range.begin(); i != range.end() && !ended.load(std::memory_order_relaxed); ++i) {
                try {
                    if (cancelled()) {
                        ended.store(true, std::memory_order_relaxed);
                        throw Error(ErrorCode::cancelled, "cancelled");
                    }
                    body(i);
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    if (i < first_index) {
                        first_index = i;
                        first = std::current_exception();
                    }
                }
            }
            results.give();
        },
        tbb::auto_partitioner());
    results.take();
    if (first) {
        std::rethrow_exception(first);
    }
}

std::size_t thread_count() {
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

} // namespace foam::base
