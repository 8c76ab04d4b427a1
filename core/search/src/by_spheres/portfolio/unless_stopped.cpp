#include "by_spheres/portfolio/problem.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>

#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

namespace foam::inline search::by_spheres {
namespace {

using Clock = std::chrono::steady_clock;

/// The request of a caller, and that of the thread before.
class StopOfCaller : public StopRequest {
public:
    explicit StopOfCaller(const std::function<bool()>& stop) : stop_(stop) {}

    bool asked() const override {
        if (stopped_) {
            return true;
        }
        if (before_.request && (before_.winds_up ? before_.request->overdue() : before_.request->asked())) {
            return true;
        }
        if (std::this_thread::get_id() == caller_ && Clock::now() >= next_) {
            ask();
        }
        return stopped_;
    }
    /// Returns whether the caller asked for the end; throws what stop() threw.
    bool stopped() const {
        if (error_) {
            std::rethrow_exception(error_);
        }
        return stopped_;
    }

private:
    void ask() const {
        constexpr std::chrono::milliseconds pause{5};
        next_ = Clock::time_point::max(); // stop() itself may check for cancellation
        try {
            stopped_ = stop_();
        } catch (...) {
            error_ = std::current_exception();
            stopped_ = true;
        }
        next_ = Clock::now() + pause;
    }

    const std::function<bool()>& stop_;
    const ThreadWork before_ = current_work();
    const std::thread::id caller_ = std::this_thread::get_id();
    mutable Clock::time_point next_{}; ///< of the calling thread alone, as error_
    mutable std::exception_ptr error_;
    mutable std::atomic<bool> stopped_{false};
};

} // namespace

bool completed_unless_stopped(const std::function<bool()>& stop, const std::function<void()>& work) {
    if (!stop) {
        work();
        return true;
    }
    const StopOfCaller request(stop);
    try {
        const StopScope scope(&request);
        work();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || !request.stopped()) {
            throw;
        }
        return false;
    }
    return !request.stopped();
}

} // namespace foam::search::by_spheres
