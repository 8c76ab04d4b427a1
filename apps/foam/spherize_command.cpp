#include "commands.hpp"
#include "execute.hpp"
#include "judge.hpp"
#include "summary.hpp"
#include "telling.hpp"
#include "written_files.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/run_json.hpp>
#include <foam/runtime/scratch_folder.hpp>
#include <foam/sdk/stage.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <iterator>

namespace foam::cli {
namespace {

namespace fs = std::filesystem;

struct SpherizeArguments {
    std::string input, method = "cover", output, format, out;
    QuickBudget budget;
    std::string max_protrusion, geometry = "collision";
    MeshUnit unit;
    std::vector<std::string> settings;
    ExecuteOptions execute;
    bool print_recipe = false, json = false;
};

bool to_stdout(const SpherizeArguments& arguments) {
    return arguments.output == "-";
}

/// Where the result goes: what -o says, or beside nothing: <stem>_spheres in the current folder.
fs::path output_file(const SpherizeArguments& arguments, const QuickRecipe& recipe) {
    return arguments.output.empty() ? fs::path(recipe.output) : fs::path(arguments.output);
}

std::string output_ending(const SpherizeArguments& arguments, const Registry& registry) {
    if (!arguments.format.empty()) {
        return arguments.format;
    }
    if (to_stdout(arguments)) {
        throw Error(ErrorCode::usage, "-o - needs --format, e.g. --format json");
    }
    if (arguments.output.empty()) {
        return is_mesh(arguments.input, registry) ? "json" : "urdf";
    }
    const std::string extension = fs::path(arguments.output).extension().string();
    if (extension.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("the format of '{}' is unknown without an extension; remedy: -o {}.json, or --format",
                                arguments.output, arguments.output));
    }
    return extension.substr(1);
}

QuickBudget budget_of(const SpherizeArguments& arguments) {
    QuickBudget budget = arguments.budget;
    if (!arguments.max_protrusion.empty()) {
        budget.max_protrusion = length_of(arguments.max_protrusion, "--max-protrusion");
    }
    return budget;
}

/// The result in one step, so that a reader never sees half of it.
void deliver(const std::string& bytes, const fs::path& scratch, const fs::path& target) {
    std::error_code error;
    const fs::path staged = scratch / "delivered";
    std::ofstream stream(staged, std::ios::binary | std::ios::trunc);
    stream << bytes;
    stream.close();
    if (stream) {
        fs::rename(staged, target, error);
    } else {
        error = std::make_error_code(std::errc::io_error);
    }
    if (error) {
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
    std::vector<WrittenFile> files = written_files(*writer, registry.find(output.writer.stage)->info, result.model,
                                                   target, target.empty() ? static_cast<Context&>(aloud) : quiet);
    if (writer->read(files.front().bytes) != writer->read(bytes_of(made))) {
        throw Error(ErrorCode::internal, fmt::format("{} gives other spheres in another folder", output.writer.stage));
    }
    return files;
}

int run_quick(const SpherizeArguments& arguments, const Recipe& recipe, const QuickRecipe& quick,
              const Registry& registry) {
    const fs::path target = output_file(arguments, quick);
    const fs::path beside = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!to_stdout(arguments) && !fs::is_directory(beside)) {
        throw Error(ErrorCode::output, fmt::format("{}: there is no folder {}", target.string(), beside.string()));
    }
    const ScratchFolder scratch = to_stdout(arguments) ? ScratchFolder() : ScratchFolder(beside);
    const fs::path directory = arguments.out.empty() ? scratch.path() / "run" : fs::path(arguments.out);
    ExecuteOptions options = arguments.execute;
    const OutputCall& output = recipe.outputs.at(0);
    const StageInfo& writer = registry.find(output.writer.stage)->info;
    if (to_stdout(arguments) && !writer.companions.empty()) {
        throw Error(ErrorCode::usage, fmt::format("{} writes several files; remedy: -o FILE", writer.name));
    }
    options.targets = to_stdout(arguments) ? std::vector<fs::path>{} : files_of(writer, target);
    options.report = !arguments.out.empty(); // the scratch folder is removed
    const RunResult result = execute(recipe, registry, directory, options);
    const std::vector<WrittenFile> files =
        result_for(to_stdout(arguments) ? fs::path() : target, directory / output.file, result, output, registry);
    if (to_stdout(arguments)) {
        print_data(files.front().bytes);
        tell_text(table_of(result, recipe.guarantee));
        return exit_code_of(result);
    }
    for (const WrittenFile& file : files) {
        deliver(file.bytes, scratch.path(), file.file);
    }
    if (arguments.json) {
        auto json = json_of_run<nlohmann::ordered_json>(result, recipe, arguments.out);
        json["files"] = file_names(files);
        print_json(json);
    } else {
        print(table_of(result, recipe.guarantee) +
              fmt::format("Written: {} ({:.2f} s)\n", fmt::join(file_names(files), ", "), result.seconds));
    }
    return exit_code_of(result);
}

int spherize(Program& program, const SpherizeArguments& arguments) {
    Registry& registry = program.registry();
    std::error_code error;
    if (!fs::is_regular_file(arguments.input, error)) {
        throw Error(ErrorCode::input, fmt::format("{}: {}", arguments.input,
                                                  fs::exists(arguments.input, error) ? "it is not a regular file"
                                                                                     : "there is no such file"));
    }
    const QuickRecipe quick = quick_recipe(arguments.input, arguments.method, output_ending(arguments, registry),
                                           budget_of(arguments), arguments.unit, arguments.geometry, registry);
    for (const std::string& stage : quick.left_out) {
        tell(fmt::format("warning: no plugin offers {}; it is skipped", stage));
    }
    const RecipeResult read = parse_recipe(quick.text, quick.name + ".yaml", registry, settings_of(arguments.settings));
    require_ok(read, arguments.input);
    if (arguments.print_recipe) {
        print_data(arguments.settings.empty() ? quick.text : to_yaml(read.recipes.at(0), registry, true));
        return 0;
    }
    return run_quick(arguments, read.recipes.at(0), quick, registry);
}

} // namespace

void add_spherize(Program& program) {
    CLI::App* command = add_command(program, "spherize", "Approximate a robot or a mesh by spheres",
                                    "  foam spherize robot.urdf -n 60           writes robot_spheres.urdf\n"
                                    "  foam spherize part.stl -n 16 -o part.json\n"
                                    "  foam spherize robot.urdf --excess 0.5    the fewest spheres with this excess\n"
                                    "  foam spherize part.stl --method grid -o - --format csv\n"
                                    "  foam spherize robot.urdf -n 60 --print-recipe > robot.yaml");
    auto arguments = std::make_shared<SpherizeArguments>();
    arguments->execute.say_which = false; // the user did
    command->add_option("input", arguments->input, "A URDF or a mesh file")->type_name("INPUT")->required();
    command
        ->add_option("-n,--spheres", arguments->budget.spheres,
                     "Maximum number of spheres of the whole robot, at most 1000000; default: the method's own "
                     "parameters decide")
        ->type_name("N")
        ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}).description(""));
    command
        ->add_option("--excess", arguments->budget.excess,
                     "Use the fewest spheres with an excess of at most X: volume of the spheres outside the robot / "
                     "volume of the robot")
        ->type_name("X");
    command
        ->add_option("--max-protrusion", arguments->max_protrusion,
                     "Limit how far spheres extend beyond their link, as far as their number allows: 10mm, 1cm, 0.4in, "
                     "or a number of metres")
        ->type_name("M");
    add_geometry(*command, arguments->geometry,
                 "The geometry of a robot that the spheres cover: collision, visual or both");
    add_mesh_unit(*command, arguments->unit);
    command->add_option("-m,--method", arguments->method, "Spherizer, with or without the prefix 'spherize.'")
        ->type_name("METHOD")
        ->capture_default_str();
    command
        ->add_option("-o,--output", arguments->output,
                     "Output file; its extension selects the format; - is the standard output; default: the name of "
                     "INPUT with _spheres, as URDF or JSON")
        ->type_name("OUT");
    command
        ->add_option("--format", arguments->format,
                     "Format of OUT, regardless of its extension: urdf, json, csv, ply, …")
        ->type_name("FORMAT");
    command->add_option("--out", arguments->out, "Keep the whole run directory in this folder")->type_name("DIR");
    command->add_flag("--print-recipe", arguments->print_recipe, "Print the equivalent recipe, and run nothing");
    add_settings(*command, arguments->settings);
    add_strict(*command, arguments->settings);
    add_execute_options(*command, arguments->execute);
    command->add_flag("--json", arguments->json, "Print the summary as JSON");
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return spherize(program, *arguments); }; });
}

} // namespace foam::cli
