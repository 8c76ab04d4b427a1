// For authors of plugins: does a plugin keep to its contract?
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/runtime/contract.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::cli {
namespace {

struct TestPluginArguments {
    std::string file;
    std::vector<std::string> samples, parameters;
};

/// Returns a value of the parameter's type, as far as the text has one; Parameters check it.
ParameterValue value_of(const Parameter& parameter, const std::string& text) {
    if (parameter.type == Parameter::Type::boolean && (text == "true" || text == "false")) {
        return text == "true";
    }
    const std::optional<double> number = parse_number(text);
    if (parameter.type == Parameter::Type::integer && number && *number == std::floor(*number)) {
        return static_cast<std::int64_t>(*number);
    }
    return parameter.type == Parameter::Type::number && number ? ParameterValue(*number) : ParameterValue(text);
}

/// Reads STAGE.PARAMETER=VALUE.
void set_parameter(const std::string& text, const Registry& registry, ContractOptions& options) {
    const std::size_t equals = text.find('='), dot = text.rfind('.', equals);
    if (equals == text.npos || dot == text.npos) {
        throw Error(ErrorCode::usage, fmt::format("--set expects STAGE.PARAMETER=VALUE, got '{}'", shown(text)));
    }
    const std::string stage = text.substr(0, dot), name = text.substr(dot + 1, equals - dot - 1);
    const RegisteredStage* registered = registry.find(stage);
    if (!registered) {
        throw Error(ErrorCode::usage, fmt::format("--set {}: the plugin has no stage '{}'", shown(text), shown(stage)));
    }
    const std::vector<Parameter>& declared = registered->info.parameters;
    const auto parameter =
        std::find_if(declared.begin(), declared.end(), [&](const Parameter& p) { return p.name == name; });
    if (parameter == declared.end()) {
        throw Error(ErrorCode::usage,
                    fmt::format("--set {}: {} has no parameter '{}'", shown(text), stage, shown(name)));
    }
    options.parameters[stage][name] = value_of(*parameter, text.substr(equals + 1));
}

int test_plugin(const TestPluginArguments& arguments) {
    Registry registry; // of this plugin alone: an installed one of the same name is not in the way
    const PluginRecord& record = registry.load(arguments.file);
    if (!record.loaded()) {
        throw Error(ErrorCode::plugin, fmt::format("plugin {} is refused: {}", record.file.string(), record.rejection));
    }
    std::size_t promises = 0;
    ContractOptions options{.samples = {arguments.samples.begin(), arguments.samples.end()},
                            .on_promise = [&](const std::string& stage, const std::string& promise) {
                                ++promises;
                                print(fmt::format("{}: {}\n", stage, promise));
                            }};
    for (const std::string& parameter : arguments.parameters) {
        set_parameter(parameter, registry, options);
    }
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
    command
        ->add_option("--set", arguments->parameters,
                     "A parameter for a stage that does nothing with its defaults; repeatable")
        ->type_name("STAGE.PARAMETER=VALUE")
        ->expected(1)
        ->take_all();
    command->callback([&program, arguments] { program.action = [arguments] { return test_plugin(*arguments); }; });
}

} // namespace foam::cli
