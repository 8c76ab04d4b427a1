// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Calls body(i) for every i in [0, count), on as many threads as the run may use. The order of the calls is not
/// defined, so write results into slots by index. If bodies throw, the exception with the smallest index is rethrown
/// after all have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Returns the number of threads that parallel_for uses.
std::size_t thread_count();

/// Limits the threads of all parallel work of the process for the life of the object; of several limits the least
/// holds. 0: no limit.
class ThreadLimit {
public:
    explicit ThreadLimit(std::size_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace base
} // namespace foam
