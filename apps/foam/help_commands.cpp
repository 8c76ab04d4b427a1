// Commands about the program itself: help, its version, schemas, the SDK, foam-bench.
#include "cli/files.hpp"
#include "cli/help.hpp"
#include "cli/messages.hpp"
#include "cli/program.hpp"
#include "commands.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/abi.hpp>
#include <foam/sdk/registry.hpp>
#include <foam/sdk/sdk.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace foam::cli {
namespace {

int help(Program& program, const std::string& name) {
    if (name.empty()) {
        // App::help() shows the command that was named, which is this one.
        print(program.app.get_formatter()->make_help(&program.app, program.app.get_name(), CLI::AppFormatMode::Normal));
        return 0;
    }
    std::vector<std::string> names;
    for (const CLI::App* command : program.app.get_subcommands(nullptr)) {
        if (command->get_name() == name) {
            print(command->help(program.app.get_name()));
            return 0;
        }
        names.push_back(command->get_name());
    }
    throw Error(ErrorCode::usage, unknown_command(shown(name), names));
}

} // namespace

void add_help(Program& program) {
    CLI::App* command = add_command(program, "help", "Explain a command",
                                    "  foam help\n"
                                    "  foam help spherize                       the same as foam spherize --help");
    auto name = std::make_shared<std::string>();
    command->add_option("command", *name, "The command; without it: the list of commands")->type_name("COMMAND");
    command->callback([&program, name] { program.action = [&program, name] { return help(program, *name); }; });
}

void add_completion(Program& program) {
    CLI::App* command = add_command(program, "completion", "Print a script that completes commands in a shell",
                                    "  source <(foam completion bash)           in ~/.bashrc\n"
                                    "  foam completion zsh > ~/.zfunc/_foam     with fpath+=~/.zfunc in ~/.zshrc\n"
                                    "  foam completion fish > ~/.config/fish/completions/foam.fish");
    auto shell = std::make_shared<std::string>();
    command->add_option("shell", *shell, "The shell")
        ->type_name(fmt::format("{}", fmt::join(completion_shells(), "|")))
        ->required();
    command->callback([&program, shell] {
        program.action = [&program, shell] {
            print_data(completion_script(described(program.app), *shell));
            return 0;
        };
    });
}

void add_manual(Program& program) {
    CLI::App* command = add_command(program, "manual", "Print a manual page for man",
                                    "  foam manual > foam.1\n"
                                    "  foam manual spherize | man -l -");
    auto name = std::make_shared<std::string>();
    command->add_option("command", *name, "The command; without it: the page of foam itself")->type_name("COMMAND");
    command->callback([&program, name] {
        program.action = [&program, name] {
            print_data(manual_page(described(program.app), *name, version()));
            return 0;
        };
    });
}

namespace {

nlohmann::ordered_json about() {
    auto libraries = library_versions();
    libraries["cli11"] = CLI11_VERSION;
    return {{"foam_version", version()},  {"foam_build", build_of_libraries()},
            {"built_from", build_text()}, {"abi", FOAM_ABI_FINGERPRINT},
            {"compiler", __VERSION__},    {"libraries", libraries}};
}

std::string text_of(const nlohmann::ordered_json& about) {
    std::string text;
    const auto add = [&text](const std::string& name, const nlohmann::ordered_json& value) {
        text += fmt::format("{:<14} {}\n", name, value.get<std::string>());
    };
    add("foam", about["foam_version"]);
    add("build", about["built_from"]);
    add("abi", about["abi"]);
    add("compiler", about["compiler"]);
    for (const auto& [name, value] : about["libraries"].items()) {
        add(name, value);
    }
    return text;
}

} // namespace

void add_version(Program& program) {
    CLI::App* command = add_command(program, "version", "Print versions and the plugin ABI", "  foam version --json");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Print the versions as JSON");
    command->callback([&program, json] {
        program.action = [json] {
            const auto all = about();
            if (*json) {
                print_json(all);
            } else {
                print(text_of(all));
            }
            return 0;
        };
    });
}

namespace {

constexpr const char* of_recipes = "recipe";

std::vector<std::string> all_names() {
    std::vector<std::string> names = schema_names();
    names.insert(names.begin(), of_recipes);
    return names;
}

int print_schema(Program& program, const std::string& name) {
    const std::string text = name == of_recipes ? recipe_schema(program.registry()) : schema_named(name);
    if (text.empty()) {
        throw Error(ErrorCode::usage, fmt::format("there is no schema '{}'; there are: {}{}", shown(name),
                                                  fmt::join(all_names(), ", "), did_you_mean(name, all_names())));
    }
    print_data(text);
    return 0;
}

} // namespace

void add_schema(Program& program) {
    CLI::App* command =
        add_command(program, "schema", "Print the JSON Schema of recipes, result files or a command's JSON",
                    "  foam schema > recipe.schema.json\n"
                    "  foam schema manifest > manifest.schema.json\n"
                    "  foam schema evaluate                     of what foam evaluate --json prints\n"
                    "\n"
                    "For completion in an editor, begin the recipe with this line:\n"
                    "  # yaml-language-server: $schema=recipe.schema.json");
    auto name = std::make_shared<std::string>(of_recipes);
    command->add_option("what", *name, "The schema")
        ->default_str(of_recipes)
        ->type_name(fmt::format("{}", fmt::join(all_names(), "|")));
    command->add_flag("--json")->description("Accepted for uniformity: the schema is always JSON");
    command->callback([&program, name] { program.action = [&program, name] { return print_schema(program, *name); }; });
}

void add_sdk(Program& program) {
    CLI::App* command = add_command(program, "sdk", "Print the folder of the SDK for CMake",
                                    "  cmake -S mine -B mine/build -DCMAKE_PREFIX_PATH=\"$(foam sdk)\"");
    command->callback([&program] {
        program.action = [] {
            print_data(sdk_prefix().string() + "\n");
            return 0;
        };
    });
}

namespace {

namespace fs = std::filesystem;

struct BenchArguments {
    std::string experiment, run_dir;
    std::size_t threads = 1;
    bool check = false, force = false;
};

struct Installed {
    fs::path package;   ///< the folder that holds the Python package
    std::string python; ///< the Python that it is for
};

/// Returns the package of this installation: that of a build, of Debian or of a wheel.
Installed package_beside(const fs::path& programs) {
    for (const auto& [folder, python] : {std::pair("../python", "python3"),
                                         {"../lib/python3/dist-packages", "/usr/bin/python3"},
                                         {"../..", "python3"}}) {
        if (fs::exists(programs / folder / "foam/bench/__main__.py")) {
            return {fs::canonical(programs / folder), python};
        }
    }
    throw Error(ErrorCode::usage,
                fmt::format("the Python package foam, which foam bench runs, is not beside {}; remedy: in a clone, run "
                            "`./foam bench` once, which builds it; for an installed foam, install the package "
                            "python3-foam",
                            programs.string()));
}

/// Replaces this program by Python with the package's experiments.
int start_bench(const BenchArguments& arguments) {
    const auto [package, default_python] = package_beside(fs::canonical(own_program).parent_path());
    const char* path = std::getenv("PYTHONPATH");
    ::setenv("PYTHONPATH", (package.string() + (path && *path ? fmt::format(":{}", path) : "")).c_str(), 1);
    const char* given = std::getenv("FOAM_PYTHON");
    const std::string python = given && *given ? given : default_python;
    std::vector<std::string> words{python, "-m", "foam.bench", fmt::format("--threads={}", arguments.threads)};
    if (!arguments.run_dir.empty()) {
        words.push_back("--run-dir=" + arguments.run_dir);
    }
    for (const auto& [flag, given_flag] : {std::pair("--force", arguments.force), {"--check", arguments.check}}) {
        if (given_flag) {
            words.emplace_back(flag);
        }
    }
    words.insert(words.end(), {"--", arguments.experiment});
    std::vector<char*> pointers;
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    ::execvp(python.c_str(), pointers.data());
    throw Error(ErrorCode::usage,
                fmt::format("{}: cannot be started: {}; foam bench needs Python; remedy: apt-get install "
                            "python3, or name one by FOAM_PYTHON",
                            python, std::strerror(errno)));
}

} // namespace

void add_bench(Program& program) {
    CLI::App* command = add_command(program, "bench", "Measure stages, write tables and plots",
                                    "  foam bench configs/experiments/filters.yaml\n"
                                    "  foam bench configs/experiments/methods.yaml --run-dir methods -j 4\n"
                                    "  foam bench my_experiment.yaml --check");
    auto arguments = std::make_shared<BenchArguments>();
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
    command->callback([&program, arguments] { program.action = [arguments] { return start_bench(*arguments); }; });
}

} // namespace foam::cli
