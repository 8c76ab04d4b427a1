// The record of a run: timings, metrics and findings by link and stage, passed to the observer as they happen.
#pragma once

#include <foam/runtime/run.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// The log of a stage while it made a result. The cache stores it with the result.
struct StageLog {
    std::string call; ///< identifies the call: results of one call share its log
    std::vector<Finding> findings;
    std::vector<StageReport::Metric> metrics;
};

struct PhaseWeight {
    std::string phase;
    double weight = 0;     ///< usual time of the phase relative to the others
    bool countable = true; ///< the number of its tasks is known at its beginning
};

/// Thread-safe.
class Journal {
public:
    explicit Journal(Observer* observer);

    /// Sets the phases of the run in order, each with its usual share of the work. For the observer they end before the
    /// run does.
    void plan(std::vector<PhaseWeight> phases);
    /// Begins a phase and ends the previous one.
    void begin(const std::string& phase);
    /// Sets the number of tasks of the phase, from which its progress follows. The number may grow.
    void expect(std::size_t tasks);
    /// Ends a round of tasks in a phase without a known end. `share`: the estimated finished share of the phase.
    void round(double share);
    void started(const std::string& link, const std::string& stage);
    void finished(const std::string& link, const StageReport& report);
    void progress(const std::string& link, const std::string& stage, double fraction);
    void finding(Finding finding);
    /// Reports the findings of a cached result, as if the stage had worked on this link now.
    void repeat(const StageLog& log, const std::string& link, const std::string& stage);
    void emit(Event::Kind kind, const std::string& message = {});

    double seconds() const;
    /// Returns the CPU time since the start, s, with that of ended children.
    double cpu_seconds() const;
    /// The time of each phase until now, and as "other" the time outside of phases. They add up to seconds() and
    /// cpu_seconds(), which are returned with them.
    struct Times {
        std::vector<RunPhase> phases;
        double seconds = 0, cpu_seconds = 0;
    };
    Times times() const;
    /// Returns the findings ordered by link, stage and text, which does not depend on threads.
    std::vector<Finding> findings() const;
    /// Returns one JSON object per line, in order of time.
    std::string events_jsonl() const;

private:
    void deliver(Event event);
    void end_phase();
    double phase_share(double running) const;
    double done_share(double running);
    std::optional<double> seconds_left(double running) const;

    Observer* observer_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double cpu_start_;
    mutable std::mutex mutex_;
    std::vector<PhaseWeight> plan_;
    std::size_t phase_ = 0; ///< index in the plan; its size before the first
    RunPhase current_;      ///< its times: those at its beginning
    std::vector<RunPhase> phases_;
    std::size_t expected_ = 0, done_ = 0;
    double rounds_ = 0; ///< share of the phase that earlier rounds have done
    double shown_ = 0;  ///< the reported share never falls when tasks are added
    std::vector<Finding> findings_;
    std::string events_;
};

/// The context of one stage call. Findings go to the journal at once. Findings and metrics are kept for the caller.
class StageContext final : public Context {
public:
    StageContext(Journal& journal, std::string link, std::string stage, std::uint64_t seed,
                 std::function<bool()> cancelled);
    std::uint64_t seed() const override { return seed_; }
    bool cancelled() const override { return cancelled_(); }
    void progress(double fraction) override;
    void log(Severity severity, std::string_view message) override;
    void metric(std::string_view name, double value, std::string_view unit) override;
    StageLog kept_log() const;

private:
    Journal& journal_;
    std::string link_, stage_;
    std::uint64_t seed_;
    std::function<bool()> cancelled_;
    mutable std::mutex mutex_;
    std::vector<Finding> findings_;
    std::map<std::string, StageReport::Metric> metrics_;
};

} // namespace runtime
} // namespace foam
