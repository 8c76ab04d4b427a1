// What each thread is at work on, kept where the handler of a crash can read it.
//
// The exception to "no globals": a signal handler can reach nothing but objects of static storage.
#pragma once

#include <foam/cancellation.hpp>

#include <cstddef>
#include <string_view>

namespace foam {

/// What to do about a crash: depends on whose code runs.
enum class CrashRemedy { isolate_stage, remove_plugin };

/// A slot of static storage. Fixed size: it is read while other threads go on.
struct Activity;

/// What a thread is at.
struct ThreadWork {
    const Activity* activity = nullptr;   ///< null: nothing that was named
    const StopRequest* request = nullptr; ///< null: nobody may ask it to end
    bool winds_up = false;                ///< it ends once the request is overdue
};

/// The calling thread works on something, for the life of the object; what it worked on before comes back then.
class ActivityScope {
public:
    /// `what`: a phrase for people, "stage 'spherize.medial', link 'hand'".
    ActivityScope(std::string_view what, CrashRemedy remedy);
    ~ActivityScope();
    ActivityScope(const ActivityScope&) = delete;
    ActivityScope& operator=(const ActivityScope&) = delete;

private:
    Activity* slot_;
    const Activity* before_;
};

/// A thread helps another: it works on the same thing for the life of the object.
class ActivityLoan {
public:
    explicit ActivityLoan(const ThreadWork& work);
    ~ActivityLoan();
    ActivityLoan(const ActivityLoan&) = delete;
    ActivityLoan& operator=(const ActivityLoan&) = delete;

private:
    ThreadWork before_;
};

/// Of the calling thread.
ThreadWork current_work();
/// Of the calling thread; null if it works on nothing that was named. Safe in a signal handler, as are those below.
const Activity* current_activity();
const char* text_of(const Activity& activity);
CrashRemedy remedy_of(const Activity& activity);
/// Who may ask for its end; null: nobody. Only to compare with: it may be gone.
const StopRequest* request_of(const Activity& activity);
/// The i-th of what all threads work on; null past the last.
const Activity* active(std::size_t i);

/// From now on every thread that works on something gets a stack of its own for signal handlers: one that ran out of
/// stack could not say so otherwise.
void provide_signal_stacks();

} // namespace foam
