// Work that one thread gives to another, told to the thread sanitizer.
#pragma once

#ifdef FOAM_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace foam {

/// What any thread did before give() happens before what a thread does after take(). It only tells: TBB sees to it, but
/// as a library that is not built with the thread sanitizer, which would take every piece of work for a data race.
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

} // namespace foam
