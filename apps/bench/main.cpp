// The command `foam bench`: a program of its own, which foam starts.
#include "cli/files.hpp"
#include "cli/messages.hpp"
#include "cli/program.hpp"

#include <foam/base/error.hpp>
#include <foam/bench/experiment.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::string experiment, run_dir;
    std::size_t threads = 1;
    bool check = false, force = false;
};

int bench(Program& program, const Arguments& arguments) {
    Registry& registry = program.registry();
    const ExperimentReading read = read_experiment(arguments.experiment, registry);
    tell_findings(read.diagnostics);
    if (!read.ok()) {
        throw Error(ErrorCode::recipe, fmt::format("{}: nothing was measured", arguments.experiment));
    }
    if (arguments.check) {
        tell(fmt::format("{}: good", arguments.experiment));
        return 0;
    }
    ExperimentOptions options;
    options.out =
        arguments.run_dir.empty() ? fs::path("benchmarks") / read.experiment->name : fs::path(arguments.run_dir);
    refuse_replacing(options.out, {arguments.experiment}, arguments.force);
    options.threads = arguments.threads;
    options.cancel = &stop_on_interrupt();
    options.tell = [](const std::string& line) { tell(line); };
    const ExperimentResult result = run_experiment(*read.experiment, registry, options);
    std::vector<std::string> files;
    for (const fs::path& file : result.files) {
        files.push_back(file.string());
    }
    print_data(result.markdown);
    tell(fmt::format("written to {}: {}", options.out.string(), fmt::join(files, " ")));
    return 0;
}

} // namespace

void add_bench(Program& program) {
    CLI::App* command = add_command(program, "bench", "Measure stages, write tables and plots",
                                    "  foam bench configs/experiments/filters.yaml\n"
                                    "  foam bench configs/experiments/methods.yaml --run-dir methods -j 4\n"
                                    "  foam bench my_experiment.yaml --check");
    auto arguments = std::make_shared<Arguments>();
    command->add_option("experiment", arguments->experiment, "The experiment, a YAML file")
        ->type_name("EXPERIMENT")
        ->required();
    add_run_directory(*command, arguments->run_dir,
                      "Folder of the results; default: benchmarks/NAME with the name of the experiment");
    refuse_output_file(*command);
    command
        ->add_option("-j,--threads", arguments->threads,
                     "Threads that a stage may use, at most 1024; 0: one per core; several threads distort CPU times")
        ->type_name("N")
        ->check(whole_number(0, 1024))
        ->capture_default_str();
    add_force(*command, arguments->force);
    command->add_flag("--check", arguments->check, "List all errors of the experiment, and measure nothing");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return bench(program, *arguments); }; });
}

} // namespace foam::cli

int main(int count, char** arguments) {
    return foam::cli::run_main(count, arguments, foam::cli::add_bench);
}
