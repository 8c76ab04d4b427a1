#include "commands.hpp"
#include "engine_option.hpp"
#include "execute.hpp"
#include "judge.hpp"

#include "cli/files.hpp"
#include "cli/messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/run_json.hpp>
#include <foam/runtime/scratch_folder.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>
#include <foam/yaml/write.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

struct SpherizeArguments {
    bool elements = false; ///< of any kind: foam approximate
    std::string input, method, output, format, engine, run_dir;
    std::vector<std::string> kinds, costs;
    std::string objective, effort;
    std::optional<std::uint64_t> seed;
    QuickBudget budget;
    std::string max_protrusion, covers = "solid";
    RobotOptions robot;
    MeshUnit unit;
    std::vector<std::string> settings, packages, xacro_arguments;
    ExecuteOptions execute;
    bool print_recipe = false, json = false;
};

bool to_stdout(const SpherizeArguments& arguments) {
    return arguments.output == "-";
}

/// Where the result goes: what -o says, or <stem>_spheres or <stem>_elements in the current folder.
fs::path output_file(const SpherizeArguments& arguments, const QuickRecipe& recipe) {
    return arguments.output.empty() ? fs::path(recipe.output) : fs::path(arguments.output);
}

std::string output_ending(const SpherizeArguments& arguments, const Registry& registry) {
    if (!arguments.engine.empty()) {
        return format_for(engine_named(arguments.engine), arguments.format,
                          to_stdout(arguments) ? "" : arguments.output, registry);
    }
    if (!arguments.format.empty()) {
        return arguments.format;
    }
    if (to_stdout(arguments)) {
        throw Error(ErrorCode::usage, "-o - needs --format, e.g. --format json");
    }
    if (arguments.output.empty()) {
        return is_mesh(arguments.input, registry) ? "json" : own_format(arguments.input, registry);
    }
    const std::string extension = fs::path(arguments.output).extension().string();
    if (extension.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("the format of '{}' is unknown without an extension; remedy: -o {}.json, or --format",
                                arguments.output, arguments.output));
    }
    return extension.substr(1);
}

/// Returns costs by the words of a recipe.
std::map<std::string, double> costs_in_words(const ElementCost& cost) {
    std::map<std::string, double> costs{{"hull_vertex", cost.of_hull_vertex}};
    for (const Element::Kind kind : every_kind()) {
        costs[to_string(kind)] = cost.of_kind[static_cast<std::size_t>(kind)];
    }
    return costs;
}

QuickBudget budget_of(const SpherizeArguments& arguments) {
    QuickBudget budget = arguments.budget;
    if (!arguments.max_protrusion.empty()) {
        budget.max_protrusion = QuickLength(length_of(arguments.max_protrusion, "--max-protrusion"),
                                            !parse_number(arguments.max_protrusion));
    }
    budget.pad = pad_of(arguments.robot);
    if (!arguments.robot.weights.empty() && !budget.spheres && !budget.excess && !budget.cost) {
        throw Error(ErrorCode::usage, fmt::format("--weight has an effect where elements are allocated; remedy: {}, or "
                                                  "--excess X",
                                                  arguments.elements ? "-n N, --cost C" : "-n N"));
    }
    for (const std::string& text : arguments.costs) {
        const std::size_t equals = text.find('=');
        const auto cost = equals == text.npos ? std::nullopt : parse_number(text.substr(equals + 1));
        if (!cost) {
            throw Error(ErrorCode::usage,
                        fmt::format("--costs expects KIND=NUMBER, such as capsule=2, got '{}'", text));
        }
        budget.costs[text.substr(0, equals)] = *cost;
    }
    if (budget.cost && budget.costs.empty() && !arguments.engine.empty()) {
        budget.costs = costs_in_words(engine_named(arguments.engine).cost);
    }
    return budget;
}

/// Throws Error(usage) for hulls beside other kinds, if the engine takes hulls of few vertices alone: only a stage for
/// hulls has a parameter for them.
void require_few_vertices(const Engine& engine, const std::vector<Element::Kind>& kinds) {
    if (engine.most_hull_vertices > 0 && kinds.size() > 1 && knows_all(kinds, {Element::Kind::hull})) {
        throw Error(ErrorCode::usage,
                    fmt::format("--for {}: {} takes hulls of at most {} vertices, which foam makes where they are the "
                                "only kind; remedy: --with hull, or other kinds",
                                engine.name, engine.title, engine.most_hull_vertices));
    }
}

QuickMethod method_of(const SpherizeArguments& arguments) {
    if (!arguments.elements) {
        QuickMethod spherizer(arguments.method);
        spherizer.objective = arguments.objective;
        return spherizer;
    }
    std::vector<Element::Kind> kinds = kinds_named(arguments.kinds, "--with");
    const Engine* engine = arguments.engine.empty() ? nullptr : &engine_named(arguments.engine);
    if (kinds.empty() && arguments.method.empty()) {
        kinds = {Element::Kind::sphere, Element::Kind::capsule, Element::Kind::box};
        std::erase_if(kinds, [&](Element::Kind kind) { return engine && !knows_all(engine->kinds, {kind}); });
    }
    if (engine) {
        require_kinds(*engine, kinds);
        require_few_vertices(*engine, kinds);
    }
    return {arguments.method, std::move(kinds), arguments.objective};
}

/// Returns the settings that --for stands for. `stage`: that makes the elements.
std::vector<std::string> settings_for_engine(const Engine& engine, const StageInfo& stage, const StageInfo& writer) {
    std::vector<std::string> settings;
    if (asks_for_engine(writer, engine)) {
        settings.push_back(fmt::format("outputs.{}.engine={}", writer.name, engine.name));
    }
    const bool makes_hulls = std::any_of(stage.parameters.begin(), stage.parameters.end(),
                                         [](const Parameter& parameter) { return parameter.name == "max_vertices"; });
    if (makes_hulls && engine.most_hull_vertices > 0) {
        settings.push_back(fmt::format("stages.{}.max_vertices={}", stage.name, engine.most_hull_vertices));
    }
    return settings;
}

/// Returns the settings of --set, and those that other options stand for; --set has the last word.
std::vector<std::string> all_settings(const SpherizeArguments& arguments, const StageInfo& stage,
                                      const StageInfo& writer) {
    std::vector<std::string> settings;
    if (!arguments.engine.empty()) {
        settings = settings_for_engine(engine_named(arguments.engine), stage, writer);
    }
    if (!arguments.effort.empty()) {
        const bool has = std::any_of(stage.parameters.begin(), stage.parameters.end(),
                                     [](const Parameter& parameter) { return parameter.name == "effort"; });
        if (!has) {
            throw Error(ErrorCode::usage, fmt::format("{} has no effort; remedy: without --effort", stage.name));
        }
        settings.push_back(fmt::format("stages.{}.effort={}", stage.name, arguments.effort));
    }
    if (arguments.seed) {
        settings.push_back(fmt::format("seed={}", *arguments.seed));
    }
    if (arguments.covers != to_string(Covers::solid)) {
        settings.push_back(fmt::format("covers={}", arguments.covers));
    }
    const auto list = [](const std::vector<std::string>& texts) {
        std::vector<std::string> values;
        std::ranges::transform(texts, std::back_inserter(values), yaml::scalar_text);
        return fmt::format("[{}]", fmt::join(values, ", "));
    };
    if (!arguments.xacro_arguments.empty()) {
        if (extension_of(arguments.input) != "xacro") {
            throw Error(ErrorCode::usage, fmt::format("'{}': only a xacro file has arguments; remedy: one INPUT",
                                                      arguments.xacro_arguments.front()));
        }
        settings.push_back("loaders.load.xacro.args=" +
                           yaml::scalar_text(fmt::format("{}", fmt::join(arguments.xacro_arguments, "\n"))));
    }
    if (!arguments.packages.empty()) {
        std::vector<std::string> entries;
        std::ranges::transform(package_path_of(arguments.packages), std::back_inserter(entries),
                               [](const fs::path& entry) { return entry.string(); });
        settings.push_back("package_path=" + list(entries));
    }
    settings.insert(settings.end(), arguments.settings.begin(), arguments.settings.end());
    return settings;
}

/// The result in one step, so that a reader never sees half of it.
void deliver(const std::string& bytes, const fs::path& target) {
    if (const std::error_code error = replace_file(target, bytes)) {
        throw Error(ErrorCode::output, fmt::format("{}: it cannot be written ({})", target.string(), error.message()));
    }
}

std::string bytes_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The result as it is to be `target` (empty: the standard output), and the files that belong to it: paths in it lead
/// from there. Its spheres are those that were proved in the run directory.
std::vector<WrittenFile> result_for(const fs::path& target, const fs::path& made, const RunResult& result,
                                    const OutputCall& output, const Registry& registry) {
    const auto writer = registry.make<Writer>(output.writer.stage, output.writer.given);
    Telling aloud;
    QuietContext quiet;
    const StageInfo& info = registry.find(output.writer.stage)->info;
    std::vector<WrittenFile> files =
        written_files(*writer, info, result.model, target, target.empty() ? static_cast<Context&>(aloud) : quiet);
    std::vector<WrittenFile> in_run = written_files(*writer, info, result.model, made, quiet);
    in_run.front().bytes = bytes_of(made);
    if (read_back(*writer, files) != read_back(*writer, in_run)) {
        throw Error(ErrorCode::internal, fmt::format("{} gives other spheres in another folder", output.writer.stage));
    }
    return files;
}

/// Tells which tool frame was taken where none was given.
void tell_tool_frame(const Recipe& recipe, const RunResult& result, const ExecuteOptions& options) {
    const std::vector<std::string>& frames = result.model.facts.tool_frames;
    if (recipe.facts.tool_frames.empty() && !frames.empty() && !options.quiet && !options.verbose) {
        tell("note: " + sentence_about_tool_frame(frames.front()));
    }
}

int run_quick(const SpherizeArguments& arguments, const Recipe& recipe, const QuickRecipe& quick,
              const Registry& registry, const fs::path& input_name) {
    const fs::path target = output_file(arguments, quick);
    const fs::path beside = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!to_stdout(arguments) && !fs::is_directory(beside)) {
        throw Error(ErrorCode::output, fmt::format("{}: there is no folder {}", target.string(), beside.string()));
    }
    const ScratchFolder scratch =
        to_stdout(arguments) || is_special_file(target) ? ScratchFolder() : ScratchFolder(beside);
    const fs::path directory = arguments.run_dir.empty() ? scratch.path() / "run" : fs::path(arguments.run_dir);
    ExecuteOptions options = arguments.execute;
    options.input_name = input_name;
    options.robot_known = [choices = choices_of(arguments.robot)](const Robot& robot) {
        require_choices(choices, robot);
    };
    const OutputCall& output = recipe.outputs.at(0);
    const StageInfo& writer = registry.find(output.writer.stage)->info;
    if (to_stdout(arguments) && !writer.companions.empty()) {
        throw Error(ErrorCode::usage, fmt::format("{} writes several files; remedy: -o FILE", writer.name));
    }
    options.targets = to_stdout(arguments) ? std::vector<fs::path>{} : files_of(writer, target);
    options.report = !arguments.run_dir.empty(); // the scratch folder is removed
    const RunResult result = execute(recipe, registry, directory, options);
    tell_tool_frame(recipe, result, options);
    const std::vector<WrittenFile> files =
        result_for(to_stdout(arguments) ? fs::path() : target, directory / output.file, result, output, registry);
    if (to_stdout(arguments)) {
        print_data(files.front().bytes);
        if (!options.quiet) {
            tell_text(table_of(result, recipe.guarantee));
        }
        return exit_code_of(result);
    }
    refuse_replacing(files, result.inputs, options.force);
    for (std::size_t i = files.size(); i-- > 0;) { // files beside the one first
        make_folder_of(files[i]);
        deliver(files[i].bytes, files[i].file);
    }
    if (arguments.json) {
        auto json = json_of_run<nlohmann::ordered_json>(result, recipe, arguments.run_dir);
        json["files"] = file_names(files);
        print_json(json);
    } else if (!options.quiet) {
        print(table_of(result, recipe.guarantee) +
              fmt::format("Written: {} ({:.2f} s)\n", names_text(files), result.seconds) +
              text_about_written(output.writer.given, arguments.engine));
    }
    return exit_code_of(result);
}

/// Throws Error(usage) for what needs a name of the input.
void require_no_name(const SpherizeArguments& arguments, const Registry& registry) {
    if (arguments.print_recipe) {
        refuse_naming("recipe", arguments.input, registry);
    }
    if (!arguments.run_dir.empty()) {
        throw Error(ErrorCode::usage, "a run directory names its input, so that the run can be repeated, and - has no "
                                      "name; remedy: a file instead of -, or without --run-dir");
    }
    if (arguments.output.empty()) {
        throw Error(ErrorCode::usage, "the input - gives the output no name; remedy: -o FILE, or -o - with --format");
    }
    refuse_naming(output_ending(arguments, registry), arguments.input, registry);
}

int spherize(Program& program, const SpherizeArguments& arguments) {
    Registry& registry = program.registry();
    if (program.standard_input.is(arguments.input)) {
        require_no_name(arguments, registry);
    }
    require_file(arguments.input);
    const std::string format = output_ending(arguments, registry);
    const QuickRecipe quick = quick_recipe(arguments.input, method_of(arguments), format,
                                           budget_of(arguments), arguments.unit, arguments.robot.geometry, registry,
                                           choices_of(arguments.robot));
    for (const std::string& stage : quick.left_out) {
        tell(fmt::format("warning: no plugin offers {}; it is skipped", stage));
    }
    const std::vector<std::string> settings =
        all_settings(arguments, registry.find(quick.stage)->info, writer_for(format, registry).info);
    const RecipeResult read = parse_recipe(quick.text, quick.name + ".yaml", registry, settings_of(settings));
    require_ok(read, arguments.input);
    if (arguments.print_recipe) {
        print_data(settings.empty() ? quick.text : to_yaml(read.recipes.at(0), registry, true));
        return 0;
    }
    return run_quick(arguments, read.recipes.at(0), quick, registry, program.standard_input.name_of(arguments.input));
}

/// Adds how many elements there may be, or how good they are to be.
void add_budget_options(CLI::App& command, SpherizeArguments& arguments, const std::string& elements) {
    command
        .add_option(arguments.elements ? "-n,--elements" : "-n,--spheres", arguments.budget.spheres,
                    fmt::format("Maximum number of {} of the whole robot, at most 1000000; default: the method's own "
                                "parameters decide",
                                elements))
        ->type_name("N")
        ->check(whole_number(1, 1'000'000));
    command
        .add_option("--excess", arguments.budget.excess,
                    fmt::format("Use the fewest {0} with an excess of at most X: volume of the {0} outside the robot / "
                                "volume of the robot",
                                elements))
        ->type_name("X")
        ->check(number_from(0));
    command
        .add_option("--max-protrusion", arguments.max_protrusion,
                    fmt::format("Limit how far {} extend beyond their link, as far as their number allows: 10mm, 1cm, "
                                "0.4in, or a number of metres",
                                elements))
        ->type_name("M");
}

void add_output_options(CLI::App& command, SpherizeArguments& arguments, const std::string& elements) {
    command
        .add_option("-o,--output", arguments.output,
                    fmt::format("Output file; its extension selects the format; - is the standard output; default: the "
                                "name of INPUT with _{}, as URDF, MJCF or JSON",
                                elements))
        ->type_name("FILE");
    command
        .add_option("--format", arguments.format,
                    "Format of the output, regardless of its extension: urdf, json, csv, ply, …")
        ->type_name("FORMAT");
    add_engine(command, arguments.engine);
    add_run_directory(command, arguments.run_dir, "Keep the whole run directory in this folder");
}

/// Adds the options that both commands have.
void add_common_options(CLI::App& command, Program& program, const std::shared_ptr<SpherizeArguments>& arguments) {
    const std::string elements = arguments->elements ? "elements" : "spheres";
    command.add_option("input", arguments->input, "A URDF, xacro, MJCF or mesh file; - is the standard input")
        ->type_name("INPUT")
        ->required();
    command.add_option("arguments", arguments->xacro_arguments, "Arguments of a xacro file, as for the program xacro")
        ->type_name("NAME:=VALUE");
    program.standard_input.may_be(arguments->input, StandardInput::Holds::geometry);
    program.standard_input.add_format(command);
    add_budget_options(command, *arguments, elements);
    using enum RobotOption;
    add_robot_options(command, arguments->robot, {geometry, keep, skip, weight, pad, lock, tool_frame});
    add_covers(command, arguments->covers,
               fmt::format("What the {} hold: solid, with the inside of what is closed, or surface alone", elements));
    add_packages(command, arguments->packages);
    add_mesh_unit(command, arguments->unit);
    CLI::Option* method =
        command
            .add_option("-m,--method", arguments->method,
                        arguments->elements
                            ? "Stage, with or without the prefix 'approximate.'; default: the one for the kind of "
                              "--with, mixed for several"
                            : "Spherizer, with or without the prefix 'spherize.'")
            ->type_name("METHOD");
    if (!arguments->elements) {
        method->capture_default_str();
    }
    command
        .add_option("--effort", arguments->effort,
                    "How long the method searches: fast, normal or best; default: normal")
        ->type_name("WORD")
        ->check(CLI::IsMember({"fast", "normal", "best"}).description(""));
    command
        .add_option("--objective", arguments->objective,
                    "What is to be least: a word of the method's objective, such as excess or protrusion")
        ->type_name("WORD");
    command.add_option("--seed", arguments->seed, "Seed of the run; default: 0")->type_name("N")->check(whole_number());
    add_output_options(command, *arguments, elements);
    command.add_flag("--print-recipe", arguments->print_recipe, "Print the equivalent recipe, and run nothing");
    add_settings(command, arguments->settings);
    add_strict(command, arguments->settings);
    add_execute_options(command, arguments->execute);
    command.add_flag("--json", arguments->json, "Print the summary as JSON");
    command.callback(
        [&program, arguments] { program.action = [&program, arguments] { return spherize(program, *arguments); }; });
}

void add_element_options(CLI::App& command, SpherizeArguments& arguments) {
    command
        .add_option("--with", arguments.kinds,
                    fmt::format("Kinds of elements: {}, separated by commas; default: sphere,capsule,box, or those of "
                                "the method",
                                fmt::join(kind_words(), ", ")))
        ->type_name("KIND[,KIND…]")
        ->delimiter(',');
    command
        .add_option("--cost", arguments.budget.cost,
                    "Maximum cost of checking all elements of the robot, instead of their number; --for has the prices "
                    "of its program")
        ->type_name("C")
        ->check(number_above(0));
    command
        .add_option("--costs", arguments.costs,
                    "Cost of a check by kind, e.g. sphere=1,capsule=2,box=4,hull_vertex=0.1")
        ->type_name("KIND=C[,…]")
        ->delimiter(',')
        ->needs("--cost");
}

} // namespace

void add_spherize(Program& program) {
    CLI::App* command = add_command(program, "spherize", "Approximate a robot or a mesh by spheres",
                                    "  foam spherize robot.urdf -n 60           writes robot_spheres.urdf\n"
                                    "  foam spherize part.stl -n 16 -o part.json\n"
                                    "  foam spherize robot.urdf --excess 0.5    the fewest spheres with this excess\n"
                                    "  foam spherize part.stl --method grid -o - --format csv\n"
                                    "  foam spherize part.stl -n 16 --set guarantee=fitted    close, not covering\n"
                                    "  foam spherize robot.xml -n 60            writes robot_spheres.xml, for MuJoCo\n"
                                    "  foam spherize robot.urdf -n 60 --skip '*finger*' --weight hand=3\n"
                                    "  foam spherize robot.urdf -n 60 --print-recipe > robot.yaml");
    auto arguments = std::make_shared<SpherizeArguments>();
    arguments->execute.say_which = false; // the user did
    arguments->method = "cover";
    add_common_options(*command, program, arguments);
}

void add_approximate(Program& program) {
    CLI::App* command = add_command(program, "approximate",
                                    "Approximate a robot or a mesh by capsules, boxes and other convex elements",
                                    "  foam approximate robot.urdf -n 20 --with capsule   writes robot_elements.urdf\n"
                                    "  foam approximate part.stl -n 8 --with hull -o part.json\n"
                                    "  foam approximate robot.urdf --cost 60 --with sphere,capsule,box\n"
                                    "  foam approximate robot.xml -n 20 --with capsule    writes robot_elements.xml\n"
                                    "  foam approximate robot.urdf -n 20 --print-recipe > robot.yaml\n"
                                    "\n"
                                    "The elements are proved to enclose the geometry, on the numbers in the file.\n"
                                    "`foam spherize` is for spheres alone.");
    auto arguments = std::make_shared<SpherizeArguments>();
    arguments->elements = true;
    arguments->execute.say_which = false; // the user did
    add_element_options(*command, *arguments);
    add_common_options(*command, program, arguments);
}

} // namespace foam::cli
