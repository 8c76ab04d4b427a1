#include "allocate/budget.hpp"
#include "finish/finish.hpp"
#include "input/inputs.hpp"
#include "process/process.hpp"
#include "record/record.hpp"
#include "write/report.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/cache.hpp>
#include <foam/runtime/internal/input.hpp>
#include <foam/runtime/internal/output.hpp>
#include <foam/runtime/run.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace foam::inline runtime {
namespace {

/// Returns the finished link; null if it has no elements.
const FinishedLink* finished_of(const LinkWork& link, const FinishedModel& finished) {
    const auto found = std::find_if(finished.links.begin(), finished.links.end(),
                                    [&](const FinishedLink& one) { return one.work == &link; });
    return found == finished.links.end() ? nullptr : &*found;
}

/// Returns the measures of a link; where its inside counts as geometry, with the missing volume of the geometry as it is,
/// of which the proof is.
Measures without_filling(const LinkWork& link, const FinishedModel& finished) {
    Measures measures = link.report.measures;
    const FinishedLink* const one = finished_of(link, finished);
    if (one && link.report.filled > 0) {
        measures.volume = one->solid->volume();
        const bool filled = measures.certified && one->solid->covers() == Covers::solid;
        measures.missing_volume = filled ? 0 : missing_volume(*one->solid, one->elements);
    }
    return measures;
}

/// Returns why the surface of a link alone is covered; empty if all of it is.
std::string why_surface_alone(const LinkWork& link, const FinishedModel& finished) {
    const FinishedLink* const one = finished_of(link, finished);
    return one ? foam::why_surface_alone(*one->solid) : "";
}

/// Returns the verdict: the links for which the guarantee is proved. A link without elements is left out. Every file
/// that is written has these links, or is not written.
ProvedLinks proved_links(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                         const FinishedModel& finished) {
    ProvedLinks proved;
    proved.guarantee = workspace.recipe.guarantee;
    proved.geometry = workspace.recipe.cover.value_or(CoveredGeometry::collision);
    proved.with_geometry = links.size();
    proved.visual_only = visual_only_links(*input.robot);
    proved.collision_only = input.collision_only;
    proved.float32 = workspace.recipe.proved_numbers(workspace.registry) == Numbers::float32;
    std::vector<Measures> measured;
    bool known = true;
    for (const LinkWork& link : links) {
        const LinkReport& report = link.report;
        if (report.skipped || !report.error.empty()) {
            proved.left_out.push_back({report.link, link.recipe.no_collision ? "collision: none in the recipe"
                                                    : report.skipped         ? "skip in the recipe"
                                                                             : "on_error: skip"});
            continue;
        }
        proved.elements = spheres_alone(report.kinds) ? proved.elements : "elements";
        if (report.measures.certified) {
            ++proved.proved;
            if (const std::string why = why_surface_alone(link, finished);
                !why.empty() && proved.guarantee == Guarantee::outer) {
                proved.as_surface.push_back({report.link, why});
            }
            measured.push_back(without_filling(link, finished));
            known = known && !(link.bounds_only && report.measures.spheres > 1); // one convex element leaves nothing out
        } else if (proved.guarantee == Guarantee::fitted) {
            measured.push_back(without_filling(link, finished));
        } else {
            proved.left_out.push_back({report.link, "the proof does not hold"});
        }
    }
    proved.missing = known ? total(measured).missing : std::numeric_limits<double>::quiet_NaN();
    return proved;
}

/// Returns the phases of a run with their usual shares of time.
std::vector<PhaseWeight> phases_of(const Recipe& recipe, bool written) {
    std::vector<PhaseWeight> phases{
        {"reading", 1}, {"filters", 10}, {"spheres", 60, false}, {"growth", 6}, {"measures", 10}};
    if (written) {
        phases.insert(phases.end(), {{"writing", 1}, {"proof", 3}});
        if (recipe.debug_meshes) {
            phases.push_back({"debug meshes", 2});
        }
        if (recipe.snapshots || recipe.debug_snapshots) {
            phases.push_back({"pictures", recipe.debug_snapshots ? 60.0 : 30.0});
        }
        phases.push_back({"visual geometry", 3});
        phases.push_back({"record", 2});
    }
    return phases;
}

void fill_result(RunResult& result, const Journal& journal, const std::vector<LinkWork>& links) {
    std::vector<Measures> measures, unpadded;
    bool padded = false;
    for (const LinkWork& link : links) {
        result.links.push_back(link.report);
        if (!link.report.skipped && link.report.error.empty()) {
            measures.push_back(link.report.measures);
            unpadded.push_back(link.report.unpadded.value_or(link.report.measures));
            padded = padded || link.report.unpadded;
        }
    }
    result.total = total(measures);
    result.total.certified = result.certified; // links that were left out belong to the robot
    result.total_unpadded = padded ? std::optional(total(unpadded)) : std::nullopt;
    result.findings = journal.findings();
    Journal::Times times = journal.times();
    result.seconds = times.seconds;
    result.cpu_seconds = times.cpu_seconds;
    result.phases = std::move(times.phases);
}

/// Reports names of the recipe that the robot does not have. Throws Error(recipe) if one of them is an error.
void check_names(const Workspace& workspace, const Input& input) {
    const std::vector<Diagnostic> findings = unknown_names(workspace.recipe, *input.robot);
    require_names(findings);
    for (const Diagnostic& finding : findings) {
        workspace.journal.finding(
            {Severity::warning, "", "", fmt::format("{}: {}", finding.where.text(), finding.message)});
    }
}

/// Returns all files that the run reads.
std::vector<std::filesystem::path> files_read(const Recipe& recipe, const RunFiles& files) {
    const std::filesystem::path folder = recipe.file.parent_path();
    std::vector<std::filesystem::path> read{files.input.file};
    if (!recipe.file.empty()) {
        read.push_back(recipe.file);
    }
    for (const RecipeFile& extended : recipe.extended) {
        read.push_back(extended.file);
    }
    for (const std::string& plugin : recipe.plugins) {
        read.push_back(folder / plugin);
    }
    for (const OutputCall& output : recipe.outputs) {
        if (!output.into.empty()) {
            read.push_back(folder / output.into);
        }
    }
    for (const InputFile& mesh : files.meshes) {
        read.push_back(mesh.file);
    }
    const std::vector<std::filesystem::path> beside = files_beside(*files.input.robot);
    read.insert(read.end(), beside.begin(), beside.end());
    return read;
}

/// Writes the model in the formats that the recipe requests, and pictures of it.
Snapshots write_model(const Workspace& workspace, const FinishedModel& finished, RunDirectory& directory,
                      RunFiles& files, RunResult& result) {
    files.outputs = write_outputs(workspace, finished, directory);
    const Workspace decorating = workspace.in(Phase::decorating);
    if (workspace.recipe.debug_meshes) {
        workspace.journal.begin("debug meshes");
        files.debug_meshes = write_debug_meshes(decorating, finished, directory);
    }
    for (const auto* written : {&files.outputs, &files.debug_meshes}) {
        for (const OutputFile& file : *written) {
            result.files.emplace_back(file.file);
        }
    }
    workspace.journal.begin("pictures");
    Snapshots pictures = write_snapshots(decorating, finished, directory);
    result.files.insert(result.files.end(), pictures.files.begin(), pictures.files.end());
    return pictures;
}

/// Writes the records of the run for people and for programs. Then the directory is complete.
void write_record(const Workspace& workspace, const FinishedModel& finished, RunDirectory& directory,
                  const RunFiles& files, const Snapshots& pictures, RunResult& result) {
    const std::string resolved = to_yaml(workspace.recipe, workspace.registry, true);
    directory.write("recipe.resolved.yaml", resolved);
    const std::string manifest = manifest_json(workspace, files, result);
    if (workspace.options.accept) {
        workspace.options.accept(manifest);
    }
    directory.write("manifest.json", manifest);
    constexpr double a_triangle = 2e-6; // s; the report thins out each mesh
    const double needed = a_triangle * static_cast<double>(result.input_size.triangles);
    if (workspace.options.report && !workspace.limits->has_time_for(needed)) {
        workspace.journal.finding(
            {Severity::warning, "", "", fmt::format("{}: the report is missing", why_dropped(workspace))});
    } else if (workspace.options.report) {
        directory.write("report.html", report_html(workspace, finished, manifest, resolved, pictures));
        result.files.emplace_back("report.html");
    }
    workspace.journal.emit(Event::Kind::run_finished);
    directory.write("events.jsonl", workspace.journal.events_jsonl());
    workspace.check_cancelled();
    directory.commit();
}

/// Returns about how many triangles the geometry has, with those that primitives are tessellated by.
std::size_t triangles_of(const std::vector<LinkWork>& links) {
    constexpr std::size_t most_of_primitives = 300'000, a_primitive = 2'000;
    std::size_t of_meshes = 0, of_primitives = 0;
    for (const LinkWork& link : links) {
        for (const CollisionElement& element : link.elements) {
            of_meshes += element.raw ? element.raw->triangles.size() : 0;
            of_primitives += element.raw ? 0 : a_primitive;
        }
    }
    return of_meshes + std::min(of_primitives, most_of_primitives);
}

/// Returns the loaded links, and the size of the input.
std::vector<LinkWork> links_of(const Workspace& workspace, const Input& input, RunFiles& files, InputSize& size) {
    std::vector<LinkWork> links = load_links(workspace, *input.robot, files.meshes);
    workspace.limits->keep_for_enclosing(triangles_of(links));
    size = input_size(*input.robot, links);
    tell_input_size(workspace, input, links, size);
    if (links.empty()) {
        refuse_without_geometry(input.file, *input.robot, workspace.recipe.cover.value_or(CoveredGeometry::collision),
                                "to turn into spheres");
    }
    tell_visual_geometry(workspace, *input.robot, links);
    return links;
}

/// What a run makes of the links.
struct Made {
    FinishedModel finished;
    std::optional<ReferenceConfiguration> reference;
    std::optional<ReferencePose> pose;
    Cut cut = Cut::none;
    bool links_lost = false;
};

/// Filters, spherizes and finishes the links.
void make_model(const Workspace& preparing, const Input& input, std::vector<LinkWork>& links, Made& made) {
    const Recipe& recipe = preparing.recipe;
    preparing.journal.begin("filters");
    filter_links(preparing, links);
    preparing.journal.begin("spheres");
    made.reference = reference_of(preparing, input.robot, links);
    if (recipe.self_collision) {
        made.pose.emplace(input.robot, made.reference ? made.reference->configuration : std::vector<double>{}, links);
    }
    std::optional<RandomPoses> poses;
    if (recipe.budget_for.value_or(BudgetFor::geometry) == BudgetFor::poses) {
        poses.emplace(input.robot, links, recipe.seed);
    }
    SpherizedLinks spherized = spherize_links(preparing, links, made.pose ? &*made.pose : nullptr,
                                              poses ? &*poses : nullptr);
    made.cut = spherized.cut;
    const Workspace workspace = preparing.in(Phase::finishing);
    const StopScope scope(workspace.request());
    made.links_lost = handle_errors(workspace, links, spherized.groups);
    made.finished = finish_links(workspace, input.robot, links, std::move(spherized.groups));
}

/// Covers each link by one sphere: what a time limit leaves time for in the end.
void enclose_model(const Workspace& workspace, const Input& input, std::vector<LinkWork>& links, Made& made) {
    workspace.limits->release_kept();
    const StopScope scope(workspace.request());
    std::vector<Group> groups = enclosed_groups(workspace, links);
    made.cut = Cut::time_limit;
    made.links_lost = handle_errors(workspace, links, groups);
    made.finished = finish_links(workspace, input.robot, links, std::move(groups));
}

/// Makes the model, or in the end one sphere for each link, so that a time limit leaves a result.
Made model_in_time(const Workspace& preparing, const Input& input, std::vector<LinkWork>& links) {
    Made made;
    try {
        make_model(preparing, input, links, made);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || !may_be_enclosed(preparing, links)) {
            throw;
        }
        enclose_model(preparing.in(Phase::finishing), input, links, made);
    }
    preparing.limits->release_kept();
    return made;
}

/// Measures the gaps to the visual geometry, while there is time.
void measure_gaps_in_time(const Workspace& workspace, const FinishedModel& finished, std::vector<LinkWork>& links) {
    try {
        measure_visual_gaps(workspace.in(Phase::completing), finished, links);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::cancelled || workspace.ended()) {
            throw;
        }
        workspace.journal.finding(
            {Severity::warning, "", "",
             fmt::format("{}: gaps to the visual geometry are missing", why_dropped(workspace))});
    }
}

RunResult run_in(const Workspace& preparing, std::optional<RunDirectory>& directory) {
    const Recipe& recipe = preparing.recipe;
    Journal& journal = preparing.journal;
    std::optional<StopScope> scope(preparing.request());
    RunResult result;
    journal.plan(phases_of(recipe, directory.has_value()));
    journal.begin("reading");
    journal.expect(1);
    const Input input = load_input(preparing);
    if (preparing.options.robot_known) {
        preparing.options.robot_known(*input.robot);
    }
    check_names(preparing, input);
    for (const std::string& sentence : facts_for_outputs(preparing, *input.robot).said) {
        journal.finding({Severity::info, "", "", sentence});
    }
    result.input = input.chosen;
    result.input_file = input.file;
    journal.emit(Event::Kind::run_started, input.file.string());

    RunFiles files{.input = input, .meshes = {}, .outputs = {}, .debug_meshes = {}};
    std::vector<LinkWork> links = links_of(preparing, input, files, result.input_size);
    result.inputs = files_read(recipe, files);
    if (preparing.options.inputs_known) {
        preparing.options.inputs_known(result.inputs);
    }
    Made made = model_in_time(preparing, input, links);
    FinishedModel& finished = made.finished;
    result.cut = made.cut;
    result.links_lost = made.links_lost;
    const Workspace workspace = preparing.in(Phase::finishing);
    scope.reset();
    scope.emplace(workspace.request());
    if (finished.links.empty()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: every link was skipped: there is nothing to write", input.file.string()));
    }
    if (made.pose) {
        report_overlaps(workspace, finished, links, *made.pose);
    }

    tell_loose_links(workspace, finished);
    tell_hollow_links(workspace, finished);
    result.proved = proved_links(workspace, input, links, finished);
    result.certified = result.proved.all();
    complete_model(workspace, input, made.reference, result.proved, finished);
    Snapshots pictures;
    if (directory) {
        pictures = write_model(workspace, finished, *directory, files, result);
    }
    if (directory && preparing.options.report) {
        journal.begin("visual geometry");
        measure_gaps_in_time(workspace, finished, links);
    }
    fill_result(result, journal, links);
    journal.begin("record");
    if (directory) {
        write_record(workspace, finished, *directory, files, pictures, result);
    } else {
        journal.emit(Event::Kind::run_finished);
    }
    result.model = std::move(finished.model);
    return result;
}

} // namespace

const char* to_string(Cut cut) {
    switch (cut) {
    case Cut::none:
        return "";
    case Cut::time_limit:
        return "time limit";
    case Cut::stop:
        return "stop";
    }
    return "";
}

RunResult run(const Recipe& recipe, const Registry& registry, const RunOptions& options) {
    const ThreadLimit threads(options.threads);
    std::optional<RunDirectory> directory;
    if (!options.out.empty()) {
        directory.emplace(options.out);
    }
    Journal journal(options.observer);
    const Cache cache(cache_folder(options));
    const std::uintmax_t limit = options.fresh ? 0 : cache_limit();
    const Workspace preparing{recipe, registry, options, journal, cache};
    const Watchdog watchdog(*preparing.limits, options, journal);
    try {
        RunResult result = run_in(preparing, directory);
        cache.keep_within(limit);
        return result;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            throw preparing.limits->explained();
        }
        throw;
    }
}

} // namespace foam::runtime
