// Cancellation of the work of a thread: loops at any depth check for it without a parameter.
#pragma once

#include <cstdint>

namespace foam {
inline namespace [[gnu::visibility("default")]] base {

/// A source of requests to end work. It is queried from any thread, often.
class StopRequest {
public:
    virtual ~StopRequest();
    /// Returns whether the work should end.
    virtual bool asked() const = 0;
    /// Returns whether there is no time left even to make a result of what was found so far.
    virtual bool overdue() const;
};

/// Returns whether the work of the calling thread should end; false if no request is installed. Threads of
/// parallel_for() work for the thread that called it.
bool cancelled();
/// Throws Error(cancelled) if cancelled(). Call it in loops that may take more than some milliseconds; parallel_for()
/// calls it before each body.
void check_cancelled();

/// Checks for cancellation at every N-th call, for loops whose bodies take less than a microsecond.
class CancellationCounter {
public:
    explicit CancellationCounter(std::uint32_t every) : every_(every), left_(every) {}
    /// Throws Error(cancelled) if this call checks and cancelled() is true.
    void check() {
        if (--left_ == 0) {
            left_ = every_;
            check_cancelled();
        }
    }

private:
    std::uint32_t every_, left_;
};

/// Puts the calling thread under a request for the life of the object; null: no request. The destructor restores the
/// previous request.
class StopScope {
public:
    explicit StopScope(const StopRequest* request);
    ~StopScope();
    StopScope(const StopScope&) = delete;
    StopScope& operator=(const StopScope&) = delete;

private:
    const StopRequest* before_;
    bool winds_up_before_;
};

/// Makes cancelled() false in the calling thread until its request is overdue, for the life of the object. It is for
/// code that checks Context::cancelled() itself and then makes a result of what it has.
class WindUpScope {
public:
    WindUpScope();
    ~WindUpScope();
    WindUpScope(const WindUpScope&) = delete;
    WindUpScope& operator=(const WindUpScope&) = delete;

private:
    bool before_;
};

} // namespace base
} // namespace foam
