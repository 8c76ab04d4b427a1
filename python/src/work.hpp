// Work beside the interpreter: on a thread aside, without its lock.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/runtime/run.hpp>

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace foam::python {

namespace py = pybind11;

/// Asks Python now and then whether a signal has raised an exception (Ctrl-C). Only Python's main thread handles
/// signals, so calls from other threads are not ended by them. Make it with the interpreter's lock.
class Signals final : public StopRequest {
public:
    Signals();
    ~Signals() override;
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    bool asked() const override;
    bool overdue() const override { return asked(); }
    /// Throws Python's exception if there was one. Call it with the interpreter's lock.
    void raise_if_asked();

private:
    using Clock = std::chrono::steady_clock;

    std::thread::id home_ = std::this_thread::get_id();
    bool main_thread_;
    mutable std::atomic<bool> raised_{false};
    mutable Clock::time_point next_ = Clock::now();
    mutable PyObject *type_ = nullptr, *value_ = nullptr, *trace_ = nullptr;
};

/// Throws Error(usage) in a child of fork() whose parent has worked: oneTBB's threads do not exist there.
void refuse_after_fork();

/// Returns work(signals), called without the interpreter's lock and under the signals as its stop request.
template <class Work> auto worked(Work work) {
    refuse_after_fork();
    Signals signals;
    try {
        auto result = [&] {
            const py::gil_scoped_release released;
            const StopScope scope(&signals);
            return work(static_cast<const Signals&>(signals));
        }();
        signals.raise_if_asked();
        return result;
    } catch (...) {
        signals.raise_if_asked(); // the request was the cause
        throw;
    }
}

/// A flag of work_aside() as a stop request.
class CancelFlag final : public StopRequest {
public:
    explicit CancelFlag(const std::atomic<bool>& cancel) : cancel_(cancel) {}
    bool asked() const override { return cancel_; }
    bool overdue() const override { return cancel_; }

private:
    const std::atomic<bool>& cancel_;
};

/// Tells when a callback was not called for a tenth of a second: it may look whether another thread wants an end.
class Pulse {
public:
    bool due() const { return Clock::now() - last_ >= std::chrono::milliseconds(100); }
    void called() { last_ = Clock::now(); }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;

    Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// Events of a run, kept until Python's thread takes them.
class Events final : public Observer {
public:
    void on(const Event& event) override;
    std::deque<Event> take();

private:
    std::mutex mutex_;
    std::deque<Event> events_;
};

/// Calls work(cancel) in a thread of its own, with the flag as its stop request, and poll() about fifty times a second
/// in this one, with the interpreter's lock, and once more at the end. An exception of poll() or of a signal's handler
/// sets `cancel`, and is thrown when the work has ended.
void work_aside(const std::function<void(const std::atomic<bool>& cancel)>& work, const std::function<void()>& poll);

} // namespace foam::python
