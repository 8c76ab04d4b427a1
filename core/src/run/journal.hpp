// What happens during a run: timings, metrics and findings by link and stage, passed on to the observer as it happens.
#pragma once

#include <foam/host/run.hpp>

#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace foam {

/// What a stage said while it made a result; goes with the result into the cache.
struct StageLog {
    std::string call; ///< tells calls apart: results made in one call share its log
    std::vector<Finding> findings;
    std::vector<StageReport::Metric> metrics;
};

struct PhaseWeight {
    std::string phase;
    double weight = 0;     ///< of its usual time among those of the others
    bool countable = true; ///< the number of its tasks is known when it begins
};

/// Thread-safe.
class Journal {
public:
    explicit Journal(Observer* observer);

    /// The phases of the run in their order, each with its usual share of the work. They end, for who watches, before
    /// the run does.
    void plan(std::vector<PhaseWeight> phases);
    /// Ends the phase before and begins this one.
    void begin(const std::string& phase);
    /// The number of tasks of the phase, for the share that is done. May grow.
    void expect(std::size_t tasks);
    /// A phase without a known end has done a round of its tasks; `share`: of the phase, as far as can be said.
    void round(double share);
    void started(const std::string& link, const std::string& stage);
    void finished(const std::string& link, const StageReport& report);
    void progress(const std::string& link, const std::string& stage, double fraction);
    void finding(Finding finding);
    /// The findings of a result that comes from the cache, as if the stage had worked on this link now.
    void repeat(const StageLog& log, const std::string& link, const std::string& stage);
    void emit(Event::Kind kind, const std::string& message = {});

    double seconds() const;
    /// CPU time since the start, s, with that of children that have ended.
    double cpu_seconds() const;
    /// What each phase took until now, and as "other" what none of them did: they add up to seconds() and
    /// cpu_seconds(), which are returned with them.
    struct Times {
        std::vector<RunPhase> phases;
        double seconds = 0, cpu_seconds = 0;
    };
    Times times() const;
    /// In an order that does not depend on threads: by link, stage and text.
    std::vector<Finding> findings() const;
    /// One JSON object a line, in the order of time.
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
    RunPhase current_;      ///< its times: when it began
    std::vector<RunPhase> phases_;
    std::size_t expected_ = 0, done_ = 0;
    double rounds_ = 0; ///< share of the phase that former rounds have done
    double shown_ = 0;  ///< the share never goes back when more tasks turn up
    std::vector<Finding> findings_;
    std::string events_;
};

/// The context of one stage call. Findings go to the journal at once; they and the metrics are kept for the caller.
class StageContext final : public Context {
public:
    StageContext(Journal& journal, std::string link, std::string stage, std::uint64_t seed,
                 std::function<bool()> cancelled);
    std::uint64_t seed() const override { return seed_; }
    bool cancelled() const override { return cancelled_(); }
    void progress(double fraction) override;
    void log(Severity severity, std::string_view message) override;
    void metric(std::string_view name, double value, std::string_view unit) override;
    StageLog said() const;

private:
    Journal& journal_;
    std::string link_, stage_;
    std::uint64_t seed_;
    std::function<bool()> cancelled_;
    mutable std::mutex mutex_;
    std::vector<Finding> findings_;
    std::map<std::string, StageReport::Metric> metrics_;
};

} // namespace foam
