// The transfer of work between threads, declared to the thread sanitizer.
#pragma once

#ifdef FOAM_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace foam::inline base {

/// Declares that what a thread did before give() happens before what a thread does after take(). It does not
/// synchronise: oneTBB does, but is not built with the thread sanitizer, which would report every transfer as a data race.
class Handover {
public:
#ifdef FOAM_THREAD_SANITIZER
    void give() {
        __tsan_release(this);
    }
    void take() {
        __tsan_acquire(this);
    }
#else
    void give() {}
    void take() {}
#endif
};

} // namespace foam::base
