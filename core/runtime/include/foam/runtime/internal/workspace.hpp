// What the parts of a run share, and how they call stages.
#pragma once

#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/base/parallel.hpp>
#include <foam/runtime/internal/cache.hpp>
#include <foam/runtime/internal/journal.hpp>
#include <foam/runtime/internal/limits.hpp>
#include <foam/runtime/run.hpp>
#include <foam/sdk/stage.hpp>

#include <exception>
#include <memory>
#include <string>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// What calls of stages share: where they report to, and what ends them.
struct Calls {
    Calls(const Registry& registry, const RunOptions& options, Journal& journal, std::uint64_t seed = 0,
          std::optional<double> time_limit = {});

    const Registry& registry;
    const RunOptions& options;
    Journal& journal;
    std::uint64_t seed; ///< of the stages, each of which gets its own
    std::shared_ptr<Limits> limits;
    Phase phase = Phase::preparing;

    /// Returns what ends the work of this phase early, except a cancellation.
    Cut cut() const { return limits->cut(phase); }
    /// Returns the time limit in s since the start of the run; nothing: no limit.
    std::optional<double> time_limit() const { return limits->time_limit(); }
    /// Returns whether stages are to end.
    bool ended() const { return limits->ended(phase); }
    /// Returns the stop request that loops of this phase poll.
    const StopRequest* request() const { return &limits->request(phase); }
    /// Throws Error(cancelled) if ended().
    void check_cancelled() const;
};

/// The shared state of one run.
struct Workspace : Calls {
    Workspace(const Recipe& recipe, const Registry& registry, const RunOptions& options, Journal& journal,
              const Cache& cache);

    const Recipe& recipe;
    const Cache& cache;

    /// Returns the same workspace in another phase of the run.
    Workspace in(Phase other) const;
    /// Returns the same workspace for another recipe, which must outlive it.
    Workspace with(const Recipe& other) const;
};

/// Returns "stage 'spherize.medial', link 'hand', input 'hand.stl'", without what is empty.
std::string place_of(const std::string& stage, const std::string& link, const std::string& input);
/// Returns the folder for cached results of stages; empty: no cache.
std::filesystem::path cache_folder(const RunOptions& options);

/// The working folder of the process, which no stage may change: relative paths would lead elsewhere.
class WorkingFolder {
public:
    WorkingFolder();
    ~WorkingFolder();
    WorkingFolder(const WorkingFolder&) = delete;
    /// Goes back to the folder if it is not the working folder any more, and throws Error(plugin).
    void require() const;

private:
    int descriptor_;
};

/// Returns an Error that names stage, link and input, whatever was thrown. Cancellation stays cancellation.
Error described(std::exception_ptr thrown, const std::string& stage, const std::string& link, const std::string& input);

/// Runs `body(context)` with a StageContext as a task of the journal: measures its time, keeps its metrics, and
/// describes what it throws. `seed` should depend on the content, not on its place, so that equal geometry gives equal
/// results.
template <class Body>
auto run_stage(const Calls& calls, const std::string& stage, const std::string& link, const std::string& input,
               const Digest& content, StageReport& report, Body&& body) {
    calls.check_cancelled();
    calls.journal.started(link, stage);
    StageContext context(calls.journal, link, stage, derive_seed(calls.seed, stage + content),
                         [&calls] { return calls.ended(); });
    const StopScope scope(calls.request());
    const ActivityScope activity(place_of(stage, link, input), CrashRemedy::isolate_stage);
    const double begin = calls.journal.seconds();
    const WorkingFolder folder;
    const auto close = [&] {
        report.stage = stage;
        report.seconds += calls.journal.seconds() - begin;
        report.metrics = context.kept_log().metrics;
        calls.journal.finished(link, report);
    };
    try {
        auto result = body(context);
        folder.require();
        close();
        return result;
    } catch (...) {
        close();
        calls.limits->interrupted_at(place_of(stage, link, input));
        throw described(std::current_exception(), stage, link, input);
    }
}

} // namespace gnu::visibility("default")]]runtime
} // namespace foam
