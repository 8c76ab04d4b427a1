// Running a checked recipe.
#pragma once

#include <foam/context.hpp>
#include <foam/host/clip_plane.hpp>
#include <foam/host/proved_links.hpp>
#include <foam/host/recipe.hpp>
#include <foam/mesh_change.hpp>
#include <foam/model.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace foam {

/// Something that happened; delivered one at a time, from any thread.
struct Event {
    enum class Kind { run_started, input_loaded, task_started, task_finished, progress, finding, run_finished };
    Kind kind = Kind::progress;
    std::string link; ///< empty: the whole run
    std::string stage;
    double seconds = 0;                 ///< since the start of the run
    double duration = 0;                ///< task_finished: seconds the task took
    bool cached = false;                ///< task_finished: taken from the cache
    double done = 0;                    ///< share of the whole run that is done, 0 to 1; below 1 before run_finished
    std::optional<double> seconds_left; ///< to the end of the run, where it can be known
    Severity severity = Severity::info;
    std::string message; ///< finding; run_started: the input's file; input_loaded: its size
};

class Observer {
public:
    virtual ~Observer();
    virtual void on(const Event& event) = 0;
};

/// What ended the search for better spheres before its time.
enum class Cut { none, time_limit, stop };
/// As manifests write it: "time limit", "stop"; empty for none.
const char* to_string(Cut cut);

/// A run that goes on although it was to end.
struct Unresponsive {
    Cut asked = Cut::stop;       ///< what it does not follow
    double seconds = 0;          ///< since the start of the run
    std::vector<std::string> at; ///< what it is at work on: "stage '…', link '…'"
};

struct RunOptions {
    std::filesystem::path out; ///< run directory; empty: nothing is written, the model is only returned
    bool fresh = false;        ///< neither read nor write the cache
    std::size_t threads = 0;   ///< 0: all cores
    const std::atomic<bool>* cancel = nullptr;
    /// Ends the search for better spheres: the best so far are written, if that is done in 1.5 s. Before there are any
    /// it cancels the run.
    const std::atomic<bool>* stop = nullptr;
    /// s since the start, in which the best that is found is to be written; instead of the recipe's. Not a tenth and half
    /// a second later than this the run has ended, with an error if there is nothing that is proved.
    std::optional<double> time_limit;
    /// Called once, from a thread of its own, when the run goes on 1.9 s after it was asked to stop, or half a second
    /// and a tenth after its time limit: a stage never asks whether to end. The program may end itself. Absent: the run
    /// has a warning that says so.
    std::function<void(const Unresponsive&)> on_unresponsive;
    Observer* observer = nullptr;
    /// The program that runs the calls of isolated stages in child processes: its main() begins with
    /// serve_isolated_call(). Empty: this one, if its main() does; else a recipe that isolates a stage is refused.
    std::filesystem::path program;
    std::filesystem::path cache; ///< empty: $XDG_CACHE_HOME/foam or ~/.cache/foam
    /// A link with a number of its own gets what the spherizer says to that number, even where it claims more than with
    /// fewer: for comparing spherizers.
    bool numbers_as_asked = false;
    /// Called with the manifest before the run directory is put in place; what it throws ends the run.
    std::function<void(const std::string& manifest)> accept;
    /// Called with all files of the robot or mesh when they are read; what it throws ends the run.
    std::function<void(const std::vector<std::filesystem::path>& files)> inputs_known;
};

/// A message of a stage about a link.
struct Finding {
    Severity severity = Severity::info;
    std::string link, stage, message;
};

struct StageReport {
    std::string stage;
    std::string input;  ///< what it worked on: a mesh reference as written, a primitive's kind
    std::string output; ///< content digest of what it made, the same whether made or taken from the cache
    double seconds = 0;
    bool cached = false;
    struct Metric {
        std::string name;
        double value = 0;
        std::string unit;
    };
    std::vector<Metric> metrics;
    std::optional<MeshChange> change; ///< of mesh filters
};

struct LinkReport {
    std::string link;
    std::vector<StageReport> stages; ///< in the order of the work, cover and measure at the end
    double growth = 0;               ///< m; largest growth of a radius that cover took
    Measures measures;
    std::vector<PlaneReach> clip; ///< of the recipe's planes for this link
    bool skipped = false;         ///< by the recipe
    std::string error;            ///< why it was lost; empty if it was not
};

/// How large a run's input is.
struct InputSize {
    Box box;                   ///< m; of all collision geometry that is read, a robot's in the reference pose
    std::size_t links = 0;     ///< with collision geometry
    std::size_t triangles = 0; ///< of their meshes
};

/// A part of the work of a run; together they are all of it.
struct RunPhase {
    std::string phase; ///< "reading", "filters", …, "other"
    double seconds = 0, cpu_seconds = 0;
};

struct RunResult {
    SphereModel model;
    std::string input; ///< the candidate that was taken, as written
    std::filesystem::path input_file;
    InputSize input_size;
    std::vector<LinkReport> links;
    std::vector<Finding> findings;
    std::vector<std::filesystem::path> files; ///< written, relative to the run directory
    Measures total;
    ProvedLinks proved;
    /// Of every link with collision geometry the guarantee is proved, on what was read back from every written file.
    bool certified = false;
    double seconds = 0; ///< wall
    double cpu_seconds = 0;
    std::vector<RunPhase> phases; ///< in their order; their times add up to those above
    Cut cut = Cut::none;          ///< if not none, the same run may give other spheres
    bool links_lost = false;      ///< done, but links were skipped after errors: exit code 4
};

/// Runs it. Throws Error naming stage, link and input; on an exception or cancellation the run directory is as it was
/// before.
RunResult run(const Recipe& recipe, const Registry& registry, const RunOptions& options = {});

/// What a run would work on: the input that resolves, without reading meshes. Throws Error(input) if none does, naming
/// all places that were tried.
ResolvedResource resolve_input(const Recipe& recipe, std::string* chosen = nullptr);

} // namespace foam
