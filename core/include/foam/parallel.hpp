// Work on all cores that gives the same result on any number of them.
#pragma once

#include <cstddef>
#include <functional>

namespace foam {

/// Calls body(i) for every i in [0, count), on as many threads as the run may use. Write results into slots by index:
/// the order of the calls is not defined. An exception of the smallest index that threw is rethrown after all have
/// ended.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// The number of threads that parallel_for uses.
std::size_t thread_count();

} // namespace foam
