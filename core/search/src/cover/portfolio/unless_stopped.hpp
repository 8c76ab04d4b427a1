// Work that ends in the middle once the caller of a search asks for it.
#pragma once

#include <functional>

namespace foam::inline search::cover {

/// Calls work(). From its cancellation checks in the calling thread, stop() is called every few milliseconds; once it
/// returns true, the work ends at its next check in any thread. Returns whether the work was completed. Without `stop`
/// it always is. Exceptions of stop() pass through; so does Error(cancelled) of a request that was there before.
bool completed_unless_stopped(const std::function<bool()>& stop, const std::function<void()>& work);

} // namespace foam::search::cover
