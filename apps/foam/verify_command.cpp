// foam verify: is a run directory what its recipe makes?
#include "cli/messages.hpp"
#include "commands.hpp"
#include "execute.hpp"

#include <foam/runtime/verify.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

namespace foam::cli {
namespace {

struct VerifyArguments {
    std::string directory;
    ExecuteOptions execute;
    bool json = false;
};

std::string text_of(const Verification& result, const std::string& directory) {
    if (result.equal()) {
        return fmt::format("{}: equal: {} digests of settings, inputs, stages and files; pictures and timings are not "
                           "compared\n",
                           directory, result.compared);
    }
    const Difference& first = result.differences.front();
    std::string text =
        fmt::format("{}: differs from its manifest\nfirst difference: {}\n  expected {}\n  found    {}\n", directory,
                    first.place(), first.expected, first.found);
    if (result.differences.size() > 1) {
        text += fmt::format("and {} more:\n", result.differences.size() - 1);
        for (std::size_t i = 1; i < result.differences.size(); ++i) {
            text += fmt::format("  {}\n", result.differences[i].place());
        }
    }
    if (!result.reasons.empty()) {
        text += fmt::format("likely reasons:\n  {}\n", fmt::join(result.reasons, "\n  "));
    }
    return text;
}

nlohmann::ordered_json json_of_verification(const Verification& result, const std::string& directory) {
    nlohmann::ordered_json json{{"directory", directory},
                                {"equal", result.equal()},
                                {"compared", result.compared},
                                {"differences", nlohmann::ordered_json::array()},
                                {"reasons", result.reasons}};
    for (const Difference& d : result.differences) {
        json["differences"].push_back(
            {{"link", d.link}, {"stage", d.stage}, {"place", d.input}, {"expected", d.expected}, {"found", d.found}});
    }
    return json;
}

int verify_run(Program& program, const VerifyArguments& arguments) {
    RunOptions options;
    options.cancel = &stop_on_interrupt();
    options.program = own_program;
    options.threads = arguments.execute.threads;
    Progress progress(arguments.execute.verbose);
    options.observer = &progress;
    const Verification result = verify(arguments.directory, program.registry(), options);
    if (arguments.json) {
        print_json(json_of_verification(result, arguments.directory));
    } else {
        print(text_of(result, arguments.directory));
    }
    return result.equal() ? 0 : 1;
}

} // namespace

void add_verify(Program& program) {
    CLI::App* command = add_command(program, "verify", "Repeat a run and compare every digest",
                                    "  foam verify runs/panda_22\n"
                                    "  foam verify runs/panda_22 -j 4 --json\n"
                                    "\n"
                                    "The command never reads the cache, and does not compare pictures.\n"
                                    "Exit codes: 0 equal, 1 different, 2 not a run directory or damaged,\n"
                                    "            3 a plugin is missing");
    auto arguments = std::make_shared<VerifyArguments>();
    command->add_option("directory", arguments->directory, "A folder that `foam run` wrote")
        ->type_name("RUNDIR")
        ->required();
    add_threads(*command, arguments->execute.threads);
    command->add_flag("-v,--verbose", arguments->execute.verbose, "Also print notes, not only warnings and errors");
    command->add_flag("--json", arguments->json, "Print the result as JSON");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return verify_run(program, *arguments); }; });
}

} // namespace foam::cli
