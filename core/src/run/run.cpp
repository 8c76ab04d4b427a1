#include <foam/host/cache.hpp>
#include <foam/host/run.hpp>

#include "debug.hpp"
#include "input.hpp"
#include "input_size.hpp"
#include "manifest.hpp"
#include "report.hpp"
#include "separation.hpp"
#include "watchdog.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <optional>

namespace foam {
namespace {

/// Of this process and the children of isolated stages.
double cpu_seconds() {
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    double sum = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        sum += seconds(usage.ru_utime) + seconds(usage.ru_stime);
    }
    return sum;
}

bool all_certified(const FinishedModel& finished) {
    for (const FinishedLink& link : finished.links) {
        if (!link.work->report.measures.certified) {
            return false;
        }
    }
    return !finished.links.empty();
}

void fill_result(RunResult& result, const Journal& journal, const std::vector<LinkWork>& links, double cpu_begin) {
    std::vector<Measures> measures;
    for (const LinkWork& link : links) {
        result.links.push_back(link.report);
        if (!link.report.skipped && link.report.error.empty()) {
            measures.push_back(link.report.measures);
        }
    }
    result.total = total(measures);
    result.findings = journal.findings();
    result.seconds = journal.seconds();
    result.cpu_seconds = cpu_seconds() - cpu_begin;
}

/// The model in the formats that the recipe asks for, and pictures of it.
Snapshots write_model(const Workspace& workspace, const FinishedModel& finished, RunDirectory& directory,
                      RunFiles& files, RunResult& result) {
    files.outputs = write_outputs(workspace, finished, directory);
    const Workspace decorating = workspace.in(Phase::decorating);
    files.debug_meshes = write_debug_meshes(decorating, finished, directory);
    for (const auto* written : {&files.outputs, &files.debug_meshes}) {
        for (const OutputFile& file : *written) {
            result.files.emplace_back(file.file);
        }
    }
    Snapshots pictures = write_snapshots(decorating, finished, directory);
    result.files.insert(result.files.end(), pictures.files.begin(), pictures.files.end());
    return pictures;
}

/// What the run was, for people and for programs. Then the directory is whole.
void write_record(const Workspace& workspace, const FinishedModel& finished, RunDirectory& directory,
                  const RunFiles& files, const Snapshots& pictures, RunResult& result) {
    const std::string resolved = to_yaml(workspace.recipe, workspace.registry, true);
    directory.write("recipe.resolved.yaml", resolved);
    const std::string manifest = manifest_json(workspace, files, result);
    if (workspace.options.accept) {
        workspace.options.accept(manifest);
    }
    directory.write("manifest.json", manifest);
    directory.write("report.html", report_html(workspace, finished, manifest, resolved, pictures));
    result.files.emplace_back("report.html");
    workspace.journal.emit(Event::Kind::run_finished);
    directory.write("events.jsonl", workspace.journal.events_jsonl());
    workspace.check_cancelled();
    directory.commit();
}

/// The links, ready to become spheres, and their size.
std::vector<LinkWork> links_of(const Workspace& workspace, const Input& input, RunFiles& files, InputSize& size) {
    std::vector<LinkWork> links = load_links(workspace, *input.robot, files.meshes);
    size = input_size(*input.robot, links);
    tell_input_size(workspace, input, links, size);
    filter_links(workspace, links);
    if (links.empty()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: no link has collision geometry: there is nothing to turn into spheres",
                                input.file.string()));
    }
    return links;
}

RunResult run_in(const Workspace& preparing, std::optional<RunDirectory>& directory, double cpu_begin) {
    const Recipe& recipe = preparing.recipe;
    Journal& journal = preparing.journal;
    std::optional<StopScope> scope(preparing.request());
    RunResult result;
    journal.expect(1);
    const Input input = load_input(preparing);
    result.input = input.chosen;
    result.input_file = input.file;
    journal.emit(Event::Kind::run_started, input.file.string());

    RunFiles files{.input = input, .meshes = {}, .outputs = {}, .debug_meshes = {}};
    std::vector<LinkWork> links = links_of(preparing, input, files, result.input_size);
    std::optional<ReferencePose> pose;
    if (recipe.self_collision) {
        pose.emplace(input.robot, recipe.self_collision_pose, links);
    }
    SpherizedLinks spherized = spherize_links(preparing, links, pose ? &*pose : nullptr);
    result.cut = spherized.cut;
    const Workspace workspace = preparing.in(Phase::finishing);
    scope.reset();
    scope.emplace(workspace.request());
    result.links_lost = handle_errors(workspace, links, spherized.groups);
    FinishedModel finished = finish_links(workspace, input.robot, links, std::move(spherized.groups));
    if (finished.links.empty()) {
        throw Error(ErrorCode::input,
                    fmt::format("{}: every link was skipped: there is nothing to write", input.file.string()));
    }
    if (pose) {
        report_overlaps(workspace, finished, links, *pose);
    }

    Snapshots pictures;
    if (directory) {
        pictures = write_model(workspace, finished, *directory, files, result);
    }
    result.certified = all_certified(finished);
    fill_result(result, journal, links, cpu_begin);
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
    std::optional<tbb::global_control> threads;
    if (options.threads > 0) {
        threads.emplace(tbb::global_control::max_allowed_parallelism, options.threads);
    }
    const double cpu_begin = cpu_seconds();
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
        RunResult result = run_in(preparing, directory, cpu_begin);
        cache.keep_within(limit);
        return result;
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            throw preparing.limits->explained();
        }
        throw;
    }
}

} // namespace foam
