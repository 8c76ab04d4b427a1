// Whether what a thread works on is to end before it is done: asked by loops at any depth, without a parameter.
#pragma once

#include <cstdint>

namespace foam {

/// Somebody who may ask for work to end. Asked from any thread, often.
class StopRequest {
public:
    virtual ~StopRequest();
    /// Whether the work is to end.
    virtual bool asked() const = 0;
    /// Whether there is no time left even to make a result of what was found so far.
    virtual bool overdue() const;
};

/// Whether the work of the calling thread is to end; false where nobody may ask. Threads of parallel_for() work for the
/// thread that called it.
bool cancelled();
/// Throws Error(cancelled) if cancelled(). Call it in loops that may take more than some milliseconds; parallel_for()
/// does before each body.
void check_cancelled();

/// Asks at every N-th call: for loops whose bodies take less than a microsecond.
class CancellationCounter {
public:
    explicit CancellationCounter(std::uint32_t every) : every_(every), left_(every) {}
    /// Throws Error(cancelled) if it asks, and cancelled() says so.
    void check() {
        if (--left_ == 0) {
            left_ = every_;
            check_cancelled();
        }
    }

private:
    std::uint32_t every_, left_;
};

/// For the life of the object the calling thread works under a request; null: nobody may ask. What it worked under
/// before comes back then.
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

/// For the life of the object cancelled() is false in the calling thread until its request is overdue: for code that
/// asks Context::cancelled() itself and then makes a result of what it has.
class WindUpScope {
public:
    WindUpScope();
    ~WindUpScope();
    WindUpScope(const WindUpScope&) = delete;
    WindUpScope& operator=(const WindUpScope&) = delete;

private:
    bool before_;
};

} // namespace foam
