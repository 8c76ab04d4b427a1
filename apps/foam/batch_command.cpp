// foam batch: spheres for data sets.
#include "cli/files.hpp"
#include "cli/messages.hpp"
#include "commands.hpp"
#include "execute.hpp"
#include "robot_options.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/batch/batch.hpp>
#include <foam/recipe/quick_recipe.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace foam::cli {

/// A line on stderr, on a terminal only: meshes, failures, rate, time left.
class BatchProgressBar {
public:
    BatchProgressBar();
    void show(const BatchProgress& progress);
    void clear();

private:
    bool terminal_, drawn_ = false;
};

namespace {

/// Returns a time span for people: "12 s", "3 min", "2.5 h", "4.1 days".
std::string span_text(double seconds) {
    return seconds < 100       ? fmt::format("{:.0f} s", seconds)
           : seconds < 6000    ? fmt::format("{:.0f} min", seconds / 60)
           : seconds < 172'800 ? fmt::format("{:.1f} h", seconds / 3600)
                               : fmt::format("{:.1f} days", seconds / 86'400);
}

} // namespace

BatchProgressBar::BatchProgressBar() : terminal_(isatty(STDERR_FILENO) != 0) {}

void BatchProgressBar::show(const BatchProgress& progress) {
    if (!terminal_ || progress.meshes == 0) {
        return;
    }
    constexpr std::size_t width = 20;
    const std::size_t filled = width * progress.done / progress.meshes;
    const double left = static_cast<double>(progress.meshes - progress.done);
    fmt::print(stderr, "\r\033[K[{:#<{}}{:.<{}}] {}/{} meshes, {} failed, {:.1f}/s{}", "", filled, "", width - filled,
               progress.done, progress.meshes, progress.failed, progress.rate,
               progress.rate > 0 ? fmt::format(", {} left", span_text(left / progress.rate)) : "");
    drawn_ = true;
}

void BatchProgressBar::clear() {
    if (drawn_) {
        fmt::print(stderr, "\r\033[K");
        drawn_ = false;
    }
}

namespace {

namespace fs = std::filesystem;

struct BatchArguments {
    std::string what, folder, run_dir, recipe, method = "cover", table;
    QuickBudget budget;
    RobotOptions robot; ///< of which a mesh has --pad
    std::vector<std::string> settings;
    BatchOptions batch;
    std::optional<std::size_t> shards;
    bool slurm = false, failures = false, no_times = false, json = false;
};

constexpr int some_failed = 4;

int batch_status_command(const BatchArguments& arguments) {
    const BatchStatus status = batch_status(arguments.folder);
    if (arguments.json) {
        print_json({{"meshes", status.meshes},
                    {"done", status.done},
                    {"failed", status.failed},
                    {"shards", status.shards},
                    {"finished_shards", status.finished_shards},
                    {"shards_worked_on", status.worked_on},
                    {"meshes_per_core_second", status.rate_of_core()},
                    {"cpu_seconds", status.cpu_seconds},
                    {"cpu_seconds_left", status.cpu_seconds_left()},
                    {"failures", status.reasons}});
        return 0;
    }
    std::string text = fmt::format("{} of {} meshes done, {} of them failed; {} of {} shards finished{}\n", status.done,
                                   status.meshes, status.failed, status.finished_shards, status.shards,
                                   status.worked_on > 0 ? fmt::format(", {} worked on now", status.worked_on) : "");
    for (const auto& [reason, count] : status.reasons) {
        text += fmt::format("{:8}  {}\n", count, shown(reason));
    }
    if (status.done > 0 && status.done < status.meshes) {
        text += fmt::format("{:.2g} meshes a second on one core; {} of work on one core are left\n",
                            status.rate_of_core(), span_text(status.cpu_seconds_left()));
    }
    print(text);
    return 0;
}

int collect_command(const BatchArguments& arguments) {
    if (arguments.table.empty()) {
        throw Error(ErrorCode::usage, "foam batch collect needs -o FILE: .jsonl, .jsonl.zst or .npz; - is the standard "
                                      "output");
    }
    const bool to_stdout = arguments.table == "-";
    const Collected table = collect_batch(arguments.folder, to_stdout ? "" : arguments.table,
                                          {.failures = arguments.failures, .times = !arguments.no_times});
    tell(fmt::format("{}: {}, {} of them failed, {} with the bytes of another one{}",
                     to_stdout ? "standard output" : arguments.table, counted(table.lines, "mesh"), table.failed, table.duplicates,
                     table.missing > 0 ? fmt::format("; {} have no result yet", table.missing) : ""));
    return table.missing > 0 ? some_failed : 0;
}

/// Reads the recipe; its mesh plays no part, and need not be there.
Recipe recipe_of_batch(const BatchArguments& arguments, Registry& registry) {
    constexpr const char* any_mesh = "mesh.stl";
    std::vector<Setting> settings = settings_of(arguments.settings);
    RecipeResult read;
    if (arguments.recipe.empty()) {
        QuickBudget budget = arguments.budget;
        budget.pad = pad_of(arguments.robot);
        const QuickRecipe quick = quick_recipe(any_mesh, arguments.method, "json", budget, {}, "collision", registry);
        for (const std::string& stage : quick.left_out) {
            tell(fmt::format("warning: no plugin offers {}; it is skipped", stage));
        }
        read = parse_recipe(quick.text, "batch.yaml", registry, settings);
    } else {
        settings.emplace_back("mesh", any_mesh);
        read = read_recipe(arguments.recipe, registry, settings);
    }
    require_ok(read, arguments.recipe.empty() ? "foam batch" : arguments.recipe);
    if (read.recipes.size() != 1) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: {} runs; remedy: a recipe without sweep", arguments.recipe, read.recipes.size()));
    }
    return read.recipes.front();
}

std::size_t number_in(const char* variable, std::size_t otherwise) {
    const char* text = std::getenv(variable);
    const auto number = text ? parse_number(text) : std::nullopt;
    return number && *number >= 0 ? static_cast<std::size_t>(*number) : otherwise;
}

bool in_slurm_array() {
    return std::getenv("SLURM_ARRAY_TASK_ID") != nullptr;
}

/// Returns the shards of a task of a Slurm job array: i, i + n, …, for task i of n.
std::vector<std::size_t> shards_of_slurm(std::size_t shards) {
    const std::size_t tasks = std::max<std::size_t>(1, number_in("SLURM_ARRAY_TASK_COUNT", 1));
    const std::size_t step = std::max<std::size_t>(1, number_in("SLURM_ARRAY_TASK_STEP", 1));
    const std::size_t first = number_in("SLURM_ARRAY_TASK_MIN", 0), id = number_in("SLURM_ARRAY_TASK_ID", 0);
    const std::size_t task = (std::max(id, first) - first) / step;
    std::vector<std::size_t> mine;
    for (std::size_t shard = task; shard < shards; shard += tasks) {
        mine.push_back(shard);
    }
    tell(fmt::format("task {} of {} of a Slurm job array: {} of {} shards", task + 1, tasks, mine.size(), shards));
    return mine;
}

/// Returns the command line of a task: that of this process with absolute paths, without --slurm.
std::vector<std::string> task_command(const BatchArguments& arguments, char** given) {
    std::vector<std::string> words{fs::read_symlink(own_program).string()};
    for (char** word = given + 1; *word; ++word) {
        const std::string text = *word;
        if (text == "--slurm") {
            continue;
        }
        const std::size_t value =
            text.starts_with("--") ? text.find('=') + 1 : 0; // 0: the word has no option before it
        const std::string given_path = text.substr(value);
        const bool is_path =
            (given_path == arguments.what || given_path == arguments.run_dir || given_path == arguments.recipe) &&
            given_path != "-";
        words.push_back(is_path ? text.substr(0, value) + fs::absolute(given_path).lexically_normal().string() : text);
    }
    return words;
}

int prepare_command(const BatchArguments& arguments, std::vector<BatchItem> items, const Recipe& recipe,
                    Program& program) {
    if (arguments.what == "-") {
        throw Error(ErrorCode::usage, "--slurm needs a list that the tasks can read again, not the standard input");
    }
    prepare_batch(std::move(items), recipe, program.registry(), arguments.batch,
                  task_command(arguments, program.arguments));
    const BatchStatus status = batch_status(arguments.run_dir);
    print(fmt::format(
        "{} meshes in {} shards\nWritten: {}/foam.sbatch, Snakefile, README.md\nNext: sbatch {}/foam.sbatch\n",
        status.meshes, status.shards, arguments.run_dir, arguments.run_dir));
    return 0;
}

int batch_command(Program& program, BatchArguments& arguments) {
    if (arguments.what == "status" || arguments.what == "collect") {
        if (arguments.folder.empty()) {
            throw Error(ErrorCode::usage, fmt::format("foam batch {} needs the folder of the results", arguments.what));
        }
        return arguments.what == "status" ? batch_status_command(arguments) : collect_command(arguments);
    }
    if (!arguments.folder.empty()) {
        throw Error(ErrorCode::usage, fmt::format("'{}' is one argument too many", arguments.folder));
    }
    if (!arguments.table.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("-o names the table of foam batch collect; remedy: --run-dir {}", arguments.table));
    }
    if (arguments.run_dir.empty()) {
        throw Error(ErrorCode::usage, "foam batch needs --run-dir DIR, the folder of the results");
    }
    Registry& registry = program.registry();
    std::vector<BatchItem> items = read_batch_list(arguments.what, registry);
    const Recipe recipe = recipe_of_batch(arguments, registry);
    BatchOptions& options = arguments.batch;
    options.folder = arguments.run_dir;
    options.shards = arguments.shards;
    if (arguments.slurm) {
        return prepare_command(arguments, std::move(items), recipe, program);
    }
    BatchProgressBar bar;
    options.stop = [] { return interrupted(); };
    options.progress = [&bar](const BatchProgress& progress) { bar.show(progress); };
    if (in_slurm_array()) {
        options.tasks = shards_of_slurm;
    }
    const BatchOutcome outcome = run_batch(std::move(items), recipe, registry, options);
    bar.clear();
    if (outcome.busy > 0) {
        tell(fmt::format("{} shards are left out: other processes work on them", outcome.busy));
    }
    if (outcome.complete && (outcome.added > 0 || !fs::exists(options.folder / "index.html"))) {
        write_batch_page(arguments.run_dir);
    }
    print(fmt::format("{}: {} with spheres, {} failed, {} without a result yet\n", counted(outcome.meshes, "mesh"),
                      outcome.meshes - outcome.failed - outcome.missing, outcome.failed, outcome.missing));
    return outcome.stopped                             ? exit_code(ErrorCode::cancelled)
           : outcome.failed > 0 || outcome.missing > 0 ? some_failed
                                                       : 0;
}

void add_batch_work(CLI::App& command, BatchArguments& arguments) {
    add_run_directory(command, arguments.run_dir, "Folder of the results; a second run goes on with what is left");
    CLI::Option* recipe = command
                              .add_option("--recipe", arguments.recipe,
                                          "The recipe for each mesh; its own mesh, outputs and pictures play no part")
                              ->type_name("FILE");
    command
        .add_option("-n,--spheres", arguments.budget.spheres,
                    "Maximum number of spheres of each mesh, instead of a recipe")
        ->type_name("N")
        ->check(whole_number(1, 1'000'000))
        ->excludes(recipe);
    command.add_option("--excess", arguments.budget.excess, "Use the fewest spheres with an excess of at most X")
        ->type_name("X")
        ->check(number_from(0))
        ->excludes(recipe);
    command.add_option("-m,--method", arguments.method, "Spherizer, with or without the prefix 'spherize.'")
        ->type_name("METHOD")
        ->capture_default_str()
        ->excludes(recipe);
    add_robot_options(command, arguments.robot, {RobotOption::pad});
    command.get_option("--pad")->excludes(recipe);
    add_settings(command, arguments.settings);
    command.add_option("--shards", arguments.shards, "Number of shards; default: one for every 1000 meshes")
        ->type_name("N")
        ->check(whole_number(1, 1'000'000));
    command
        .add_option("--shard", arguments.batch.only,
                    "Work on this shard alone, numbered from 0; repeatable; default: all, or those of the task of a "
                    "Slurm job array")
        ->type_name("I")
        ->check(whole_number(0, 999'999));
    command
        .add_option("-j,--workers", arguments.batch.workers, "Worker processes, one mesh each; default: one per core")
        ->type_name("N")
        ->check(whole_number(1, 1024));
    command.add_option("--time-limit", arguments.batch.time_limit, "Limit of the time of one mesh in seconds")
        ->type_name("S")
        ->check(number_above(0))
        ->capture_default_str();
    command
        .add_option("--memory-limit", arguments.batch.memory_limit,
                    "Limit of the memory of one worker in MiB; 0: none; default: 4096")
        ->type_name("N")
        ->check(whole_number(0, 1'000'000'000));
    command.add_flag("--slurm", arguments.slurm,
                     "Write foam.sbatch, Snakefile and README.md into DIR, and work on nothing");
}

} // namespace

void add_batch(Program& program) {
    CLI::App* command = add_command(program, "batch", "Approximate each mesh of a data set by spheres",
                                    "  foam batch objects/ -n 8 --run-dir spheres/\n"
                                    "  foam batch objects.jsonl --recipe eight.yaml --run-dir spheres/ --slurm\n"
                                    "  foam batch objects.jsonl --recipe eight.yaml --run-dir spheres/ --shard 17\n"
                                    "  foam batch status spheres/\n"
                                    "  foam batch collect spheres/ -o spheres.jsonl.zst");
    auto arguments = std::make_shared<BatchArguments>();
    command
        ->add_option("what", arguments->what,
                     "A list (.jsonl, .csv, .txt), a folder, an archive (.zip, .tar) or a glob in quotes; - is the "
                     "standard input; or the word status or collect")
        ->type_name("LIST")
        ->required();
    command->add_option("folder", arguments->folder, "For status and collect: the folder of the results")
        ->type_name("DIR");
    add_batch_work(*command, *arguments);
    command
        ->add_option("-o,--output", arguments->table,
                     "collect: the table, .jsonl, .jsonl.zst or .npz; - is the standard output")
        ->type_name("FILE");
    command->add_flag("--failures", arguments->failures, "collect: only the meshes that failed");
    command->add_flag("--no-times", arguments->no_times, "collect: without times; equal work gives equal bytes");
    command->add_flag("--json", arguments->json, "status: print the state as JSON");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return batch_command(program, *arguments); };
    });
}

} // namespace foam::cli
