// The threads that foam works with: how many, and what each does now.
#pragma once

#include <foam/base/cancellation.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

// The current work of each thread, where the handler of a crash can read it.
//
// This is the exception to "no globals": a signal handler can access only objects of static storage.

/// The remedy for a crash, which depends on whose code runs.
enum class CrashRemedy { isolate_stage, remove_plugin };

/// A slot of static storage with a fixed size: it is read while other threads continue.
struct Activity;

/// The current work of a thread.
struct ThreadWork {
    const Activity* activity = nullptr;   ///< null: no named work
    const StopRequest* request = nullptr; ///< null: nothing can request its end
    bool winds_up = false;                ///< the work ends once the request is overdue
};

/// A phrase for people, cut off where it is too long. Zero-terminated, without memory of its own: for signal handlers.
using ActivityText = std::array<char, 512>;

/// Sets the work of the calling thread for the lifetime of the object; the previous work is restored at its end.
class ActivityScope {
public:
    /// Begins the work. `what`: a phrase for people, "stage 'spherize.medial', link 'hand'".
    ActivityScope(std::string_view what, CrashRemedy remedy);
    ~ActivityScope();
    ActivityScope(const ActivityScope&) = delete;
    ActivityScope& operator=(const ActivityScope&) = delete;

private:
    Activity* slot_;
    const Activity* before_;
};

/// Lends the work of another thread to the calling thread for the lifetime of the object.
class ActivityLoan {
public:
    explicit ActivityLoan(const ThreadWork& work);
    ~ActivityLoan();
    ActivityLoan(const ActivityLoan&) = delete;
    ActivityLoan& operator=(const ActivityLoan&) = delete;

private:
    ThreadWork before_;
};

/// Returns the work of the calling thread.
ThreadWork current_work();
/// Returns the activity of the calling thread; null if it has no named work. Safe in a signal handler, as are the
/// functions below.
const Activity* current_activity();
/// Returns a copy of what the thread works on; "" if it changes meanwhile.
ActivityText text_of(const Activity& activity);
CrashRemedy remedy_of(const Activity& activity);
/// Returns the request that may end the activity; null: none. Only for comparison: it may no longer exist.
const StopRequest* request_of(const Activity& activity);
/// Returns the i-th activity over all threads; null after the last.
const Activity* active(std::size_t i);

/// Gives every thread that works on something its own stack for signal handlers from now on: without it a stack
/// overflow could not be reported.
void provide_signal_stacks();

/// Calls `body`, whose loops use at most so many threads; 0: as many as there are. Other calls at the same time are
/// not limited by it.
void on_threads(std::size_t threads, const std::function<void()>& body);

/// Calls `body`. A thread that waits for a loop within it starts no task of a loop outside it.
void isolated(const std::function<void()>& body);

/// The version of oneTBB; empty without it.
std::string onetbb_version();

} // namespace base
} // namespace foam
