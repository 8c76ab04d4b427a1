#include "execute.hpp"

#include "cli/files.hpp"
#include "cli/messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

void tell_input(const Recipe& recipe) {
    std::string chosen;
    const ResolvedResource found = resolve_input(recipe, &chosen);
    const auto& candidates = recipe.urdf.empty() ? recipe.mesh : recipe.urdf;
    tell(fmt::format("{}: input {} ({})", recipe.name, chosen, found.path.string()));
    const auto taken = std::find(candidates.begin(), candidates.end(), chosen);
    if (taken != candidates.begin()) {
        tell(fmt::format("{}: not found before it: {}", recipe.name, fmt::join(candidates.begin(), taken, ", ")));
    }
}

} // namespace

void add_execute_options(CLI::App& command, ExecuteOptions& options) {
    add_threads(command, options.threads);
    command.add_flag("--fresh", options.fresh, "Do not use the cache");
    command
        .add_option("--time-limit", options.time_limit,
                    "Write the best elements that foam finds within S seconds of the start")
        ->type_name("S")
        ->check(number_above(0));
    add_force(command, options.force);
    CLI::Option* verbose =
        command.add_flag("-v,--verbose", options.verbose, "Also print notes, not only warnings and errors");
    command.add_flag("-q,--quiet", options.quiet, "Print only warnings and errors: no progress, no table")
        ->excludes(verbose);
}

void require_ok(const RecipeResult& read, const std::string& what) {
    tell_findings(read.diagnostics);
    if (!read.ok()) {
        const auto errors = std::count_if(read.diagnostics.begin(), read.diagnostics.end(),
                                          [](const Diagnostic& d) { return d.level == Diagnostic::Level::error; });
        throw Error(ErrorCode::recipe,
                    fmt::format("{}: {} in the recipe; nothing was run", what, counted(errors, "error")));
    }
}

RunResult execute(const Recipe& recipe, const Registry& registry, const std::filesystem::path& directory,
                  const ExecuteOptions& options) {
    RunOptions run_options;
    run_options.stop = &stop_on_interrupt();
    run_options.on_unresponsive = give_up;
    run_options.time_limit = options.time_limit;
    if (options.say_which && !options.quiet) {
        tell_input(recipe);
    }
    run_options.out = directory;
    run_options.input_name = options.input_name;
    run_options.fresh = options.fresh;
    run_options.report = options.report;
    run_options.threads = options.threads;
    run_options.accept = options.accept;
    run_options.robot_known = options.robot_known;
    run_options.inputs_known = [&](const std::vector<std::filesystem::path>& inputs) {
        for (const std::filesystem::path& target : options.targets) {
            refuse_overwriting(target, inputs, options.force);
        }
        refuse_replacing(directory, inputs, options.force);
    };
    run_options.inputs_known({resolve_input(recipe).path});
    Progress progress(options.verbose, options.quiet);
    run_options.observer = &progress;
    return run(recipe, registry, run_options);
}

int exit_code_of(const RunResult& result) {
    constexpr int links_left_out = 4;
    return result.cut == Cut::stop || interrupted() ? exit_code(ErrorCode::cancelled)
           : result.links_lost                      ? links_left_out
                                                    : 0;
}

} // namespace foam::cli
