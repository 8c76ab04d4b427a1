#include <foam/base/internal/activity.hpp>

#include <foam/base/error.hpp>

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <tuple>

namespace foam::inline base {

struct Activity {
    std::atomic<bool> taken{false};
    std::atomic<CrashRemedy> remedy{CrashRemedy::isolate_stage};
    std::atomic<const StopRequest*> request{nullptr};
    /// A sequence lock (Boehm: Can seqlocks get along with programming language memory models?, MSPC 2012): odd while the
    /// text changes. A reader never waits, so a signal handler may read.
    std::atomic<std::uint32_t> version{0};
    std::array<std::atomic<char>, std::tuple_size_v<ActivityText>> text{};
};

namespace {

// The most calls at the same time that are named: threads times the depth of nested calls.
std::array<Activity, 1024> slots;
std::atomic<bool> wants_signal_stacks{false};

// initial-exec: a signal handler must not be the first to access it, because that allocates.
__attribute__((tls_model("initial-exec"))) thread_local ThreadWork current;

/// A thread's stack for signal handlers, unless it already has one (sanitizers provide their own).
class SignalStack {
public:
    SignalStack() {
        stack_t existing{};
        if (sigaltstack(nullptr, &existing) != 0 || !(existing.ss_flags & SS_DISABLE)) {
            return;
        }
        memory_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory_ == MAP_FAILED) {
            memory_ = nullptr;
            return;
        }
        stack_t stack{};
        stack.ss_sp = memory_;
        stack.ss_size = size;
        sigaltstack(&stack, nullptr);
    }
    ~SignalStack() {
        if (memory_) {
            stack_t none{};
            none.ss_flags = SS_DISABLE;
            sigaltstack(&none, nullptr);
            munmap(memory_, size);
        }
    }
    SignalStack(const SignalStack&) = delete;
    SignalStack& operator=(const SignalStack&) = delete;

private:
    static constexpr std::size_t size = 64 * 1024;
    void* memory_ = nullptr;
};

void provide_signal_stack() {
    if (wants_signal_stacks.load(std::memory_order_relaxed)) {
        thread_local const SignalStack stack;
    }
}

Activity* free_slot() {
    for (Activity& slot : slots) {
        if (!slot.taken.load(std::memory_order_relaxed) && !slot.taken.exchange(true, std::memory_order_acquire)) {
            return &slot;
        }
    }
    return nullptr;
}

/// Writes the text, release by release: a reader that sees one of its characters sees that the version is odd, or later.
void write_text(Activity& activity, std::string_view text) {
    const std::size_t length = std::min(text.size(), activity.text.size() - 1);
    activity.version.fetch_add(1, std::memory_order_relaxed);
    for (std::size_t i = 0; i <= length; ++i) {
        activity.text[i].store(i < length ? text[i] : '\0', std::memory_order_release);
    }
    activity.version.fetch_add(1, std::memory_order_release);
}

} // namespace

ActivityScope::ActivityScope(std::string_view what, CrashRemedy remedy) : slot_(free_slot()), before_(current.activity) {
    provide_signal_stack();
    if (slot_) {
        write_text(*slot_, what);
        slot_->remedy.store(remedy, std::memory_order_relaxed);
        slot_->request.store(current.request, std::memory_order_relaxed);
    }
    current.activity = slot_;
}

ActivityScope::~ActivityScope() {
    current.activity = before_;
    if (slot_) {
        slot_->taken.store(false, std::memory_order_release);
    }
}

ActivityLoan::ActivityLoan(const ThreadWork& work) : before_(current) {
    provide_signal_stack();
    current = work;
}

ActivityLoan::~ActivityLoan() {
    current = before_;
}

ThreadWork current_work() {
    return current;
}

const Activity* current_activity() {
    return current.activity;
}

ActivityText text_of(const Activity& activity) {
    ActivityText copy{};
    const std::uint32_t before = activity.version.load(std::memory_order_acquire);
    for (std::size_t i = 0; i + 1 < copy.size(); ++i) {
        copy[i] = activity.text[i].load(std::memory_order_acquire);
        if (copy[i] == '\0') {
            break;
        }
    }
    const bool whole = before % 2 == 0 && activity.version.load(std::memory_order_relaxed) == before;
    return whole ? copy : ActivityText{};
}

CrashRemedy remedy_of(const Activity& activity) {
    return activity.remedy.load(std::memory_order_relaxed);
}

const StopRequest* request_of(const Activity& activity) {
    return activity.request.load(std::memory_order_relaxed);
}

const Activity* active(std::size_t i) {
    for (const Activity& slot : slots) {
        if (slot.taken.load(std::memory_order_acquire) && i-- == 0) {
            return &slot;
        }
    }
    return nullptr;
}

StopRequest::~StopRequest() = default;

bool StopRequest::overdue() const {
    return asked();
}

bool cancelled() {
    return current.request && (current.winds_up ? current.request->overdue() : current.request->asked());
}

void check_cancelled() {
    if (cancelled()) {
        throw Error(ErrorCode::cancelled, "cancelled");
    }
}

StopScope::StopScope(const StopRequest* request) : before_(current.request), winds_up_before_(current.winds_up) {
    current.request = request;
    current.winds_up = false;
}

StopScope::~StopScope() {
    current.request = before_;
    current.winds_up = winds_up_before_;
}

WindUpScope::WindUpScope() : before_(current.winds_up) {
    current.winds_up = true;
}

WindUpScope::~WindUpScope() {
    current.winds_up = before_;
}

void provide_signal_stacks() {
    wants_signal_stacks.store(true, std::memory_order_relaxed);
    provide_signal_stack();
}

} // namespace foam::base
