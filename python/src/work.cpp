#include "work.hpp"

#include <foam/base/error.hpp>

#include <unistd.h>

namespace foam::python {
namespace {

constexpr auto between_checks = std::chrono::milliseconds(20);

bool is_main_thread() {
    const py::module_ threading = py::module_::import("threading");
    return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

} // namespace

Signals::Signals() : main_thread_(is_main_thread()) {}

Signals::~Signals() {
    Py_XDECREF(type_);
    Py_XDECREF(value_);
    Py_XDECREF(trace_);
}

bool Signals::asked() const {
    if (raised_.load(std::memory_order_relaxed)) {
        return true;
    }
    if (!main_thread_ || std::this_thread::get_id() != home_) {
        return false;
    }
    const Clock::time_point now = Clock::now();
    if (now < next_) {
        return false;
    }
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) {
        PyErr_Fetch(&type_, &value_, &trace_);
        raised_ = true;
    }
    next_ = Clock::now() + between_checks;
    return raised_;
}

void Signals::raise_if_asked() {
    if (raised_) {
        raised_ = false;
        PyErr_Restore(std::exchange(type_, nullptr), std::exchange(value_, nullptr), std::exchange(trace_, nullptr));
        throw py::error_already_set();
    }
}

void refuse_after_fork() {
    static const pid_t first = getpid(); // of the first work
    if (getpid() != first) {
        throw Error(ErrorCode::usage,
                    "this process is a fork of one that has used foam, and its threads did not come along; remedy: "
                    "start processes by 'spawn' or 'forkserver', e.g. multiprocessing.get_context('spawn')");
    }
}

} // namespace foam::python
