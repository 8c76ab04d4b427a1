// What else foam's libraries need of the library that schedules parallel loops: oneTBB, or none (cmake -DFOAM_TBB=OFF).
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// Calls `body`, whose loops use at most so many threads; 0: as many as there are. Other calls at the same time are
/// not limited by it.
void on_threads(std::size_t threads, const std::function<void()>& body);

/// Calls `body`. A thread that waits for a loop within it starts no task of a loop outside it.
void isolated(const std::function<void()>& body);

/// The version of oneTBB; empty without it.
std::string onetbb_version();

} // namespace base
} // namespace foam
