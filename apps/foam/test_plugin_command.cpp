// For authors of plugins: does a plugin keep to its contract?
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/contract.hpp>

#include <fmt/format.h>

namespace foam::cli {
namespace {

struct TestPluginArguments {
    std::string file;
    std::vector<std::string> samples;
};

int test_plugin(const TestPluginArguments& arguments) {
    Registry registry; // of this plugin alone: an installed one of the same name is not in the way
    const PluginRecord& record = registry.load(arguments.file);
    if (!record.loaded()) {
        throw Error(ErrorCode::plugin, fmt::format("plugin {} is refused: {}", record.file.string(), record.rejection));
    }
    std::size_t promises = 0;
    const ContractOptions options{.samples = {arguments.samples.begin(), arguments.samples.end()},
                                  .on_promise = [&](const std::string& stage, const std::string& promise) {
                                      ++promises;
                                      print(fmt::format("{}: {}\n", stage, promise));
                                  }};
    std::size_t broken = 0;
    for (const std::string& name : record.stages) {
        for (const ContractFinding& finding : check_contract(*registry.find(name), registry, options)) {
            ++broken;
            tell(fmt::format("{} does not keep the promise '{}': {}", finding.stage, finding.promise, finding.message));
        }
    }
    print(fmt::format("{}: {} of {} promises kept\n", record.name, promises - broken, promises));
    return broken == 0 ? 0 : exit_code(ErrorCode::geometry);
}

} // namespace

void add_test_plugin(Program& program) {
    CLI::App* command = add_command(program, "test-plugin", "Check that a plugin keeps its contract",
                                    "  foam test-plugin build/spherize_mine.so\n"
                                    "  foam test-plugin build/load_mine.so --sample part.mine");
    auto arguments = std::make_shared<TestPluginArguments>();
    command->add_option("file", arguments->file, "The plugin, a shared library")->type_name("FILE")->required();
    command->add_option("--sample", arguments->samples, "A file for the tested loader to read; repeatable")
        ->type_name("FILE")
        ->expected(1)
        ->take_all()
        ->check(CLI::Validator(CLI::ExistingFile).description(""));
    command->callback([&program, arguments] { program.action = [arguments] { return test_plugin(*arguments); }; });
}

} // namespace foam::cli
