// When the work of a run is to end: who asks for it, and what that means in each phase.
#pragma once

#include "journal.hpp"

#include <foam/cancellation.hpp>
#include <foam/error.hpp>
#include <foam/host/run.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>

namespace foam {

/// How far a run is, which says what a request to stop means.
enum class Phase {
    preparing,  ///< there is nothing to write yet: a stop cancels the run
    searching,  ///< a stop ends the search for better spheres, a time limit as long before it as finishing may take
    beginning,  ///< the first spheres of a shape, or what they cost: as long as there is time to finish with them
    covering,   ///< what was found is made to cover and measured: as long as there is time to write something else
    finishing,  ///< what was found is written
    decorating, ///< pictures and meshes for people: only while there is time for nothing else to do
};

/// Belongs to one run. Safe to call from any thread.
///
/// A run has ended a tenth and 0.3 s after its time limit, or 1.5 s after it was asked to stop: with what it found, or
/// with an error.
class Limits {
public:
    Limits(const RunOptions& options, std::optional<double> time_limit, const Journal& journal);

    /// s since the start of the run.
    std::optional<double> time_limit() const { return time_limit_; }
    /// What ends the work of a phase before its time, but for a cancellation and for the end of the run.
    Cut cut(Phase phase) const;
    /// Whether the work of a phase is to end.
    bool ended(Phase phase) const;
    /// Whether there is no time either for a result of what it has.
    bool overdue(Phase phase) const;
    /// The same for loops that ask the thread.
    const StopRequest& request(Phase phase) const { return requests_[static_cast<std::size_t>(phase)]; }
    bool owns(const StopRequest* request) const;

    /// What finishing a shape was seen to take: it is kept in reserve.
    void add_to_reserve(double seconds, std::size_t times, std::size_t threads);
    /// Keeps the place in which the run was when its time was over, for explained().
    void interrupted_at(const std::string& place);
    /// What to tell of a cancellation that comes out of the run.
    Error explained() const;
    /// What the run is asked to do, and the s since its start after which it does not answer; nothing: it may go on.
    struct Due {
        Cut asked;
        double seconds;
    };
    std::optional<Due> due() const;

private:
    class Request final : public StopRequest {
    public:
        void bind(const Limits& limits, Phase phase) {
            limits_ = &limits;
            phase_ = phase;
        }
        bool asked() const override { return limits_->ended(phase_); }
        bool overdue() const override { return limits_->overdue(phase_); }

    private:
        const Limits* limits_ = nullptr;
        Phase phase_ = Phase::preparing;
    };

    std::optional<double> stopped() const;
    std::optional<double> hard_end() const;
    bool is_over() const;
    double reserve() const;
    bool too_late_to_begin() const;
    bool too_late_to_cover() const;

    const RunOptions& options_;
    const std::optional<double> time_limit_;
    const Journal& journal_;
    std::array<Request, 6> requests_;
    mutable std::atomic<double> stopped_{-1}; ///< s; when a request to stop was seen first
    std::atomic<double> all_{0}, longest_{0}; ///< s; of finishing shapes
    mutable std::mutex mutex_;
    std::string place_;
};

} // namespace foam
