#include "work.hpp"

namespace foam::python {
namespace {

constexpr auto between_polls = std::chrono::milliseconds(20);

/// A thread that does the work, and says when it has ended.
class Aside {
public:
    explicit Aside(const std::function<void(const std::atomic<bool>&)>& work)
        : thread_([this, &work] {
              try {
                  const CancelFlag request(cancel_);
                  const StopScope scope(&request);
                  work(cancel_);
              } catch (...) {
                  error_ = std::current_exception();
              }
              const std::lock_guard lock(mutex_);
              ended_ = true;
              changed_.notify_all();
          }) {}
    ~Aside() { join(); }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;

    void cancel() { cancel_ = true; }
    /// Waits a moment; returns whether the work has ended.
    bool wait() {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(lock, between_polls, [this] { return ended_; });
    }
    std::exception_ptr join() {
        if (thread_.joinable()) {
            thread_.join();
        }
        return error_;
    }

private:
    std::atomic<bool> cancel_{false};
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ended_ = false;
    std::exception_ptr error_;
    std::thread thread_; // the last: it uses the others
};

} // namespace

void Events::on(const Event& event) {
    const std::lock_guard lock(mutex_);
    events_.push_back(event);
}

std::deque<Event> Events::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(events_, {});
}

void work_aside(const std::function<void(const std::atomic<bool>& cancel)>& work, const std::function<void()>& poll) {
    refuse_after_fork();
    std::exception_ptr of_python, of_work;
    {
        const py::gil_scoped_release released;
        Aside aside(work);
        while (!aside.wait()) {
            const py::gil_scoped_acquire lock;
            if (of_python) {
                continue; // it is only waited for
            }
            try {
                poll();
                if (PyErr_CheckSignals() != 0) {
                    throw py::error_already_set();
                }
            } catch (...) {
                of_python = std::current_exception();
                aside.cancel();
            }
        }
        of_work = aside.join();
    }
    if (of_python) {
        std::rethrow_exception(of_python);
    }
    poll();
    if (of_work) {
        std::rethrow_exception(of_work);
    }
}

} // namespace foam::python
