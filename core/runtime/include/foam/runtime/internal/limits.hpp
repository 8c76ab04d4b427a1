// The end of the work of a run: who requests it, and what that means in each phase.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/runtime/internal/journal.hpp>
#include <foam/runtime/run.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// The phase of a run. It determines the effect of a request to stop.
enum class Phase {
    preparing,  ///< there is no result yet: a stop cancels the run
    searching,  ///< a stop ends the search for better spheres; a time limit ends it early enough for finishing
    beginning,  ///< first spheres of a shape, and their cost: as long as there is time to finish with them
    covering,   ///< growing and measuring the result: as long as there is time to write another one instead
    completing, ///< what the result can do without: as long as there is time to write it
    finishing,  ///< writing the result
    decorating, ///< pictures and meshes for people: only while there is time for nothing else to do
};

/// The limits of one run. Safe to call from any thread.
///
/// A run ends at most a tenth and 0.3 s after its time limit, or 1.5 s after a request to stop: with its result so far,
/// or with an error. A result that is there by then is proved and written even if that takes up to 2 s longer.
class Limits {
public:
    Limits(const RunOptions& options, std::optional<double> time_limit, const Journal& journal);

    /// Returns the time limit, s since the start of the run.
    std::optional<double> time_limit() const { return time_limit_; }
    /// Returns what ends the work of a phase early, except a cancellation and the hard end of the run.
    Cut cut(Phase phase) const;
    /// Returns whether the work of a phase is to end.
    bool ended(Phase phase) const;
    /// Returns whether there is no time even for a result from what is known.
    bool overdue(Phase phase) const;
    /// Returns the same as a request that loops on a thread can poll.
    const StopRequest& request(Phase phase) const { return requests_[static_cast<std::size_t>(phase)]; }
    bool owns(const StopRequest* request) const;

    /// Keeps time for one enclosing sphere of each link, which take the place of any other result: before that, work
    /// of every phase but completing ends so much earlier. `triangles`: of the geometry.
    void keep_for_enclosing(std::size_t triangles);
    /// Releases that time: there is a result to prove and to write, or only the enclosing spheres are left to make.
    void release_kept();
    /// Returns whether a time limit, and no request to stop, has ended the work early enough for enclosing spheres.
    bool may_enclose() const;

    /// Returns whether work of so many seconds ends within the time limit.
    bool has_time_for(double seconds) const;

    /// Adds the measured time for finishing a shape to the reserve.
    void add_to_reserve(double seconds, std::size_t times, std::size_t threads);
    /// Keeps the place of the run at its time limit, for explained().
    void interrupted_at(const std::string& place);
    /// Returns the error for a cancellation that ends the run.
    Error explained() const;
    /// The request to the run, and the time in s since its start after which it counts as unresponsive.
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
    std::optional<double> hard_end(Phase phase) const;
    double end_of_limit() const;
    bool is_over(Phase phase) const;
    double reserve() const;
    bool too_late_to_begin() const;
    bool too_late_to_cover() const;
    bool too_late_to_complete() const;

    /// Returns whether the caller has cancelled: by the options, or without them by the request under which it called.
    bool is_cancelled() const;

    const RunOptions& options_;
    /// Of the thread that made this, where the options say nothing of an end: a file is read, nothing is run. Null:
    /// none.
    const StopRequest* outer_;
    const std::optional<double> time_limit_;
    const Journal& journal_;
    std::array<Request, 7> requests_;
    mutable std::atomic<double> stopped_{-1}; ///< s; when a request to stop was first seen
    std::atomic<double> all_{0}, longest_{0}; ///< s; for finishing shapes
    std::atomic<double> kept_{0};             ///< s; for enclosing spheres
    std::atomic<double> writing_{0};          ///< s; for the proof of what is written, by the size of the geometry
    std::atomic<bool> only_writing_is_left_{false};
    mutable std::mutex mutex_;
    std::string place_;
};

} // namespace runtime
} // namespace foam
