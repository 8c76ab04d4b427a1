#include <foam/runtime/verify.hpp>

#include "input/inputs.hpp"
#include "record/record.hpp"

#include <foam/base/error.hpp>
#include <foam/base/internal/files.hpp>
#include <foam/runtime/scratch_folder.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace foam::inline runtime {
namespace fs = std::filesystem;
namespace {

void require_plugins(const Record& record, const Registry& registry) {
    std::string missing;
    for (const PluginVersion& plugin : record.plugins) {
        const auto& all = registry.plugins();
        if (std::none_of(all.begin(), all.end(),
                         [&](const PluginRecord& p) { return p.loaded() && p.name == plugin.name; })) {
            missing += fmt::format("\n  {} {}", plugin.name, plugin.version);
        }
    }
    if (!missing.empty()) {
        throw Error(
            ErrorCode::plugin,
            fmt::format(
                "{}: the run needs plugins that are not loaded here:{}\n"
                "remedy: install them, or name them with --plugin; `foam plugins --why` shows why plugins were refused",
                record.source, missing));
    }
}

Recipe resolved_recipe(const fs::path& directory, const Record& record, Registry& registry) {
    const fs::path file = directory / "recipe.resolved.yaml";
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: there is no such file, and without it the run cannot be repeated; remedy: `foam "
                                "run --locked {} RECIPE` with the recipe that was published",
                                file.string(), record.source));
    }
    const RecipeResult read = read_recipe(file, registry);
    require_plugins(record, registry);
    if (!read.ok()) {
        std::string findings;
        for (const Diagnostic& finding : read.diagnostics) {
            findings += "\n  " + finding.text();
        }
        throw Error(ErrorCode::recipe, fmt::format("{}: the recipe is damaged:{}", file.string(), findings));
    }
    Recipe recipe = read.recipes.at(0);
    recipe.snapshots = recipe.debug_snapshots = false; // pixels are not compared
    return recipe;
}

/// Returns the differences of the inputs. `elsewhere`: reasons for them.
std::vector<Difference> compare_inputs(const Record& expected, const Recipe& recipe, const Registry& registry,
                                       std::vector<std::string>& elsewhere) {
    std::optional<InputsHere> here;
    std::vector<Difference> differences;
    try {
        here = inputs_here(recipe, registry);
        differences = compare(expected.inputs, here->digests);
    } catch (const Error& error) {
        const Checkpoint& input = expected.inputs.front();
        differences.push_back({"", input.stage, input.input, input.digest, error.what()});
    }
    if (!differences.empty()) {
        elsewhere = inputs_elsewhere(expected, here);
    }
    return differences;
}

/// Runs the recipe. An error is a difference, too.
std::optional<Record> run_again(const Recipe& recipe, const Registry& registry, const RunOptions& options,
                                std::vector<Difference>& differences) {
    const ScratchFolder scratch;
    RunOptions again;
    again.out = scratch.path() / "run";
    again.fresh = true;
    again.threads = options.threads;
    again.cancel = options.cancel;
    again.time_limit = std::numeric_limits<double>::infinity();
    again.observer = options.observer;
    again.program = options.program;
    try {
        run(recipe, registry, again);
    } catch (const Error& error) {
        if (error.code() == ErrorCode::cancelled) {
            throw;
        }
        differences.push_back({"", "run", "", "a finished run", error.what()});
        return std::nullopt;
    }
    return read_record(again.out / "manifest.json");
}

/// Compares the files of the run directory with the manifest.
std::vector<Difference> compare_files(const fs::path& directory, const std::vector<RecordedFile>& files) {
    std::vector<Difference> differences;
    for (const RecordedFile& file : files) {
        const auto differs = [&](std::string found) {
            differences.push_back({"", "file in the run directory", file.file,
                                   fmt::format("{} ({} bytes)", file.digest, file.bytes), std::move(found)});
        };
        std::error_code error;
        if (!fs::exists(directory / file.file, error)) {
            differs("nothing: the file is missing");
            continue;
        }
        try {
            const std::string bytes = read_file(directory / file.file);
            if (const Digest digest = digest_of(bytes); digest != file.digest) {
                differs(fmt::format("{} ({} bytes: the file was {})", digest, bytes.size(),
                                    bytes.size() < file.bytes ? "truncated" : "changed"));
            }
        } catch (const Error& failure) {
            differs(failure.what());
        }
    }
    return differences;
}

} // namespace

std::string Difference::place() const {
    std::string text = link.empty() ? "" : fmt::format("link '{}'", link);
    if (!stage.empty()) {
        text += fmt::format("{}{}", text.empty() ? "" : ", ",
                            stage.find('.') == stage.npos ? stage : fmt::format("stage '{}'", stage));
    }
    return input.empty() ? text : fmt::format("{}, '{}'", text, input);
}

Verification verify(const fs::path& directory, Registry& registry, const RunOptions& options) {
    std::error_code error;
    if (!fs::is_directory(directory, error)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: {}; name a folder that `foam run` made", directory.string(),
                                fs::exists(directory, error) ? "this is not a folder" : "there is no such folder"));
    }
    const Record expected = read_record(directory / "manifest.json");
    require_whole(expected);
    const Recipe recipe = resolved_recipe(directory, expected, registry);

    Verification result;
    const auto add = [&result](std::vector<Difference> differences) {
        std::move(differences.begin(), differences.end(), std::back_inserter(result.differences));
    };
    add(compare_settings(expected.settings, settings_of(recipe, registry)));
    add(compare_inputs(expected, recipe, registry, result.reasons));
    result.compared = expected.inputs.size();
    if (const auto found = run_again(recipe, registry, options, result.differences)) {
        for (const auto list : {&Record::stages, &Record::outputs, &Record::debug_meshes}) {
            add(compare(expected.*list, (*found).*list));
            result.compared += (expected.*list).size();
        }
        for (std::string& reason : other_versions(expected, *found)) {
            result.reasons.push_back(std::move(reason));
        }
    }
    add(compare_files(directory, expected.files));
    result.compared += expected.files.size();
    return result;
}

} // namespace foam::runtime
