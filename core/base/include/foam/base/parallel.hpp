// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Calls body(i) for every i in [0, count), on as many threads as the run may use. The order of the calls is not
/// defined, so write results into slots by index. If bodies throw, the exception with the smallest index is rethrown
/// after all have ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// Returns the number of threads that parallel_for uses.
std::size_t thread_count();

} // namespace base
} // namespace foam
