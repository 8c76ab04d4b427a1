#include "handover.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/base/parallel.hpp>

#ifndef FOAM_SERIAL // the one place that knows oneTBB
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/version.h>
#endif

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace foam::inline base {

#ifdef FOAM_SERIAL

namespace {

template <typename Body>
void in_ranges(std::size_t count, const Body& body) {
    body(0, count);
}

} // namespace

std::size_t thread_count() {
    return 1;
}

struct ThreadLimit::State {};
ThreadLimit::ThreadLimit(std::size_t) {}

void on_threads(std::size_t, const std::function<void()>& body) {
    body();
}

void isolated(const std::function<void()>& body) {
    body();
}

std::string onetbb_version() {
    return "";
}

#else

namespace {

/// Calls body(begin, end) for ranges that together are [0, count).
template <typename Body>
void in_ranges(std::size_t count, const Body& body) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); },
        tbb::auto_partitioner());
}

} // namespace

std::size_t thread_count() {
    return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

struct ThreadLimit::State {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::size_t threads)
    : state_(threads > 0 ? new State{{tbb::global_control::max_allowed_parallelism, threads}} : nullptr) {}

void on_threads(std::size_t threads, const std::function<void()>& body) {
    if (threads == 0) {
        body();
        return;
    }
    const std::size_t cores = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    tbb::task_arena arena(static_cast<int>(std::min(threads, cores))); // TBB warns about more
    arena.execute(body);
}

void isolated(const std::function<void()>& body) {
    tbb::this_task_arena::isolate(body);
}

std::string onetbb_version() {
    return TBB_runtime_version();
}

#endif

ThreadLimit::~ThreadLimit() = default;

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
    std::mutex mutex;
    std::exception_ptr first;
    std::size_t first_index = count;
    const ThreadWork shared = current_work();
    std::atomic<bool> ended = false; // exceptions of a million bodies would take seconds
    Handover work, results;
    work.give();
    in_ranges(count, [&](std::size_t begin, std::size_t end) {
        work.take();
        const ActivityLoan loan(shared);
        for (std::size_t i = begin; i != end && !ended.load(std::memory_order_relaxed); ++i) {
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
    });
    results.take();
    if (first) {
        std::rethrow_exception(first);
    }
}

} // namespace foam::base
