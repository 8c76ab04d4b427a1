// What the parts of a run share, and how they call stages.
#pragma once

#include "cache.hpp"
#include "data/activity.hpp"
#include "digest.hpp"
#include "journal.hpp"

#include <foam/error.hpp>
#include <foam/host/run.hpp>
#include <foam/parallel.hpp>
#include <foam/stage.hpp>

#include <exception>
#include <memory>
#include <string>

namespace foam {

/// How far a run is, which says what a request to stop means.
enum class Phase {
    preparing, ///< there is nothing to write yet: a stop cancels the run, a time limit waits
    searching, ///< a stop or the time limit ends the search for better spheres, what is known stays
    finishing, ///< what was found is written
};

/// Belongs to one run.
struct Workspace {
    const Recipe& recipe;
    const Registry& registry;
    const RunOptions& options;
    Journal& journal;
    const Cache& cache;
    Phase phase = Phase::preparing;

    /// The same in another phase of the run.
    Workspace in(Phase other) const { return {recipe, registry, options, journal, cache, other}; }
    /// What ends the work of this phase before its time, but for a cancellation.
    Cut cut() const;
    /// s since the start of the run; nothing: none.
    std::optional<double> time_limit() const;
    /// Whether stages are to give up.
    bool ended() const;
    /// Throws Error(cancelled) if ended().
    void check_cancelled() const;
};

/// "stage 'spherize.medial', link 'hand', input 'hand.stl'"; what is empty is left out.
std::string place_of(const std::string& stage, const std::string& link, const std::string& input);
/// Where the results of stages are kept; empty: nowhere.
std::filesystem::path cache_folder(const RunOptions& options);

/// An Error that names stage, link and input, whatever was thrown. Cancellation stays cancellation.
Error described(std::exception_ptr thrown, const std::string& stage, const std::string& link, const std::string& input);

/// Runs `body(context)`, with a StageContext, as a task of the journal: timed, its metrics kept, what it throws
/// described. `seed` should depend on what is worked on, not on where it stands, so that equal geometry gives equal
/// results.
template <class Body>
auto run_stage(const Workspace& workspace, const std::string& stage, const std::string& link, const std::string& input,
               const Digest& content, StageReport& report, Body&& body) {
    workspace.check_cancelled();
    workspace.journal.started(link, stage);
    StageContext context(workspace.journal, link, stage, derive_seed(workspace.recipe.seed, stage + content),
                         [&workspace] { return workspace.ended(); });
    const ActivityScope activity(place_of(stage, link, input), CrashRemedy::isolate_stage);
    const double begin = workspace.journal.seconds();
    const auto close = [&] {
        report.stage = stage;
        report.seconds += workspace.journal.seconds() - begin;
        report.metrics = context.said().metrics;
        workspace.journal.finished(link, report);
    };
    try {
        auto result = body(context);
        close();
        return result;
    } catch (...) {
        close();
        throw described(std::current_exception(), stage, link, input);
    }
}

} // namespace foam
