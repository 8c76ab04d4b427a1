// Runs a checked recipe.
#pragma once

#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/mesh_checks.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/robot/proved_links.hpp>
#include <foam/sdk/context.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/model.hpp>

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// An event of a run. Events are delivered one at a time, from any thread.
struct Event {
    enum class Kind { run_started, input_loaded, task_started, task_finished, progress, finding, run_finished };
    Kind kind = Kind::progress;
    std::string link; ///< empty: the whole run
    std::string stage;
    double seconds = 0;                 ///< since the start of the run
    double duration = 0;                ///< task_finished: seconds the task took
    bool cached = false;                ///< task_finished: taken from the cache
    double done = 0;                    ///< share of the whole run that is done, 0 to 1; below 1 before run_finished
    std::optional<double> seconds_left; ///< to the end of the run, if known
    Severity severity = Severity::info;
    std::string message; ///< finding; run_started: the input's file; input_loaded: its size
};

class Observer {
public:
    virtual ~Observer();
    virtual void on(const Event& event) = 0;
};

/// The reason why the search for better spheres ended early.
enum class Cut { none, time_limit, stop };
/// Returns the word in manifests: "time limit", "stop"; empty for none.
const char* to_string(Cut cut);

/// The report about a run that continues although it should end.
struct Unresponsive {
    Cut asked = Cut::stop;       ///< the request that it does not follow
    double seconds = 0;          ///< since the start of the run
    std::vector<std::string> at; ///< its current activities: "stage '…', link '…'"
};

/// A robot or a mesh that was read, with its meshes: Original::loaded.
struct LoadedInput;

struct RunOptions {
    std::filesystem::path out; ///< run directory; empty: nothing is written, the model is only returned
    bool fresh = false;        ///< neither read nor write the cache
    bool report = true;        ///< write report.html, with gaps to visual geometry; wasted if the directory is removed
    std::size_t threads = 0;   ///< 0: all cores
    const std::atomic<bool>* cancel = nullptr;
    /// Ends the search for better elements: the best so far are written, if that takes at most 1.5 s. If there
    /// are none yet, it cancels the run.
    const std::atomic<bool>* stop = nullptr;
    /// Time limit, s since the start, in which the best result must be written; it replaces the recipe's. The run has
    /// ended at most a tenth of it and half a second later, with an error if nothing is proved.
    std::optional<double> time_limit;
    /// Called once, from a separate thread, when the run continues 1.9 s after a stop request, or half a second and a
    /// tenth after its time limit: a stage does not check for cancellation. The program may end itself. Absent: the run
    /// logs a warning.
    std::function<void(const Unresponsive&)> on_unresponsive;
    Observer* observer = nullptr;
    /// The program that runs the calls of isolated stages in child processes: its main() begins with
    /// serve_isolated_call(). Empty: this program, if its main() does; else a recipe that isolates a stage is rejected.
    std::filesystem::path program;
    std::filesystem::path cache; ///< empty: $XDG_CACHE_HOME/foam or ~/.cache/foam
    /// Called with the manifest before the run directory is put in place; an exception from it ends the run.
    std::function<void(const std::string& manifest)> accept;
    /// Called with all files that the run reads once they are known: the recipe and those that it extends, the robot or
    /// mesh, its meshes and visuals, the files that outputs edit, plugins; an exception from it ends the run.
    std::function<void(const std::vector<std::filesystem::path>& files)> inputs_known;
    /// What the run works on, in place of the input that the recipe names: none of its files is read again, whatever has
    /// become of them. The recipe's unit, package_path and loaders do not count for it. Null: the recipe's input.
    std::shared_ptr<const LoadedInput> input{};
    /// The name that the content of the recipe's URDF goes by: relative references lead from its folder. It need not
    /// exist; empty: the file's own.
    std::filesystem::path input_name{};
    /// Called with the robot once it is read, before its meshes are; an exception from it ends the run.
    std::function<void(const Robot& robot)> robot_known{};
};

/// A message of a stage about a link.
struct Finding {
    Severity severity = Severity::info;
    std::string link, stage, message;
};

struct StageReport {
    std::string stage;
    std::string input;  ///< its input: a mesh reference as written, a primitive's kind
    std::string output; ///< content digest of its output, the same whether computed or taken from the cache
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

/// How far the visual geometry of a link extends beyond its spheres.
struct VisualGap {
    double length = 0;   ///< m; from above, to 0.1 %
    std::string unknown; ///< why it could not be measured; empty if it was
};

struct LinkReport {
    std::string link;
    std::vector<StageReport> stages; ///< in the order of the work, cover and measure at the end
    double growth = 0;               ///< m; largest growth of a radius
    Measures measures;
    double pad = 0;                   ///< m; added to all radii after the growth
    double filled = 0;                ///< m³; of hollow insides that count as geometry in the measures
    std::optional<Measures> unpadded; ///< the measures before the padding, if there is any
    std::vector<PlaneReach> clip; ///< of the recipe's half-space constraints for this link
    bool skipped = false;         ///< by the recipe
    /// With a report: of links with spheres and visual geometry that is not to be covered.
    std::optional<VisualGap> visual_gap;
    std::string error;            ///< why the link failed; empty if it did not
    KindCounts kinds{};           ///< of its elements
};

/// The size of a run's input.
struct InputSize {
    Box box;                   ///< m; of all geometry to be covered, a robot's in the reference pose
    std::size_t links = 0;     ///< with geometry to be covered
    std::size_t triangles = 0; ///< of their meshes
};

/// A part of the work of a run; the phases together are the whole run.
struct RunPhase {
    std::string phase; ///< "reading", "filters", …, "other"
    double seconds = 0, cpu_seconds = 0;
};

struct RunResult {
    SphereModel model;
    std::string input; ///< the candidate that was used, as written
    std::filesystem::path input_file;
    InputSize input_size;
    std::vector<std::filesystem::path> inputs; ///< the files that were read, as RunOptions::inputs_known has them
    std::vector<LinkReport> links;
    std::vector<Finding> findings;
    std::vector<std::filesystem::path> files; ///< written, relative to the run directory
    Measures total;
    std::optional<Measures> total_unpadded; ///< before the padding, if a link has any
    ProvedLinks proved;
    /// Whether the guarantee is proved for every link with geometry to be covered, on the numbers read back from every
    /// written file.
    bool certified = false;
    double seconds = 0; ///< wall
    double cpu_seconds = 0;
    std::vector<RunPhase> phases; ///< in order; their times add up to those above
    Cut cut = Cut::none;          ///< if not none, the same run may give other spheres
    bool links_lost = false;      ///< the run ended, but links were skipped after errors: exit code 4
};

/// Runs the recipe. Throws Error naming stage, link and input. On an exception or cancellation the run directory is as
/// it was before.
RunResult run(const Recipe& recipe, const Registry& registry, const RunOptions& options = {});

/// Returns the input of a run: the candidate that resolves, without reading meshes. Throws Error(input) if none does,
/// naming all places that were searched.
ResolvedResource resolve_input(const Recipe& recipe, std::string* chosen = nullptr);

} // namespace runtime
} // namespace foam
