// Long work of foam beside Python's own thread, which meanwhile hears Ctrl-C and calls back.
#pragma once

#include "work.hpp"

#include <foam/runtime/run.hpp>

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>

namespace foam::python {

/// Events of a run, kept until Python's thread takes them.
class Events final : public Observer {
public:
    void on(const Event& event) override;
    std::deque<Event> take();

private:
    std::mutex mutex_;
    std::deque<Event> events_;
};

/// Calls work(cancel) in a thread of its own, and poll() about fifty times a second in this one, with the interpreter's
/// lock, and once more at the end. An exception of poll() or of a signal's handler sets `cancel`, and is thrown when
/// the work has ended.
void work_aside(const std::function<void(const std::atomic<bool>& cancel)>& work, const std::function<void()>& poll);

} // namespace foam::python
