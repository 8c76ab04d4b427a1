// foam convert: a sphere model from any format that is read to any that is written.
#include "commands.hpp"
#include "engine_option.hpp"
#include "execute.hpp"
#include "judge.hpp"

#include "cli/files.hpp"
#include "cli/messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/judge/written_model.hpp>
#include <foam/recipe/quick_recipe.hpp>
#include <foam/runtime/version.hpp>
#include <foam/sdk/kinds.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

struct ConvertArguments {
    std::string model, robot, output, format, engine, reader, into, base_link, covers = "solid";
    RobotOptions options;
    std::vector<std::string> pose, renames, packages, settings;
    std::size_t threads = 0;
    bool force = false, verbose = false;
};

std::string ending_of_output(const std::string& output) {
    const std::string extension = std::filesystem::path(output).extension().string();
    if (extension.empty()) {
        throw Error(ErrorCode::usage,
                    fmt::format("the format of '{}' is unknown without an extension; remedy: --format FORMAT; `foam "
                                "formats` lists them",
                                output));
    }
    return extension.substr(1);
}

/// Returns the text of a file of the user.
std::string text_of_file(const std::string& file) {
    constexpr std::uintmax_t most = 64'000'000;
    FileContents contents = read_regular_file(file, most, "give a robot file");
    if (!contents.problem.empty()) {
        throw Error(ErrorCode::input, file + ": " + contents.why_not());
    }
    return std::move(contents.bytes);
}

/// Adds the padding to all radii; prints the excess before and after.
void pad_and_tell(SphereFile& file, const RobotOptions& options, const Original* original) {
    const auto excess = [&] { return evaluate(*original, match(*original, file)).total.measures.excess; };
    const double before = original ? excess() : 0;
    pad(file, options, original);
    if (original) {
        tell(fmt::format("padding of {} m: excess {:.3f} before, {:.3f} after", to_text(pad_of(options)->metres), before,
                         excess()));
    }
}

/// Removes the elements of links that are not chosen; with the robot, what is chosen must be of it.
void keep_chosen(SphereFile& file, const RobotChoices& choices, const Original* original) {
    require_choices(choices, original ? *original->robot : *links_alone(file));
    std::erase_if(file.links, [&](const LinkSpheres& link) { return !is_chosen(choices, link.link); });
}

KindCounts kinds_in(const SphereModel& model) {
    KindCounts kinds{};
    for (const SphereGroup& group : model.groups) {
        kinds = sum_of(kinds, kinds_of(group.tree.elements()));
    }
    return kinds;
}

/// Returns the model of a file with all that the arguments say of it, and what the writer wants to know.
SphereModel model_of(const SphereFile& file, const Original* original, const ConvertArguments& arguments,
                     const StageInfo& writer, const std::map<std::string, ParameterValue>& parameters) {
    SphereModel model = sphere_model_of(file, original ? original->robot : links_alone(file));
    for (const OriginalLink& link : original ? original->links : std::vector<OriginalLink>{}) {
        model.geometry[link.link] = link.solid;
    }
    const RobotChoices choices = choices_of(arguments.options);
    model.facts = {.base_link = arguments.base_link,
                   .tool_frames = choices.tool_frames,
                   .lock_joints = choices.locks,
                   .default_pose = positions_of(arguments.pose, "--pose"),
                   .acceleration = {},
                   .jerk = {}};
    if (const std::string taken = give_tool_frame(model.facts, *model.robot, writer, !arguments.into.empty());
        !taken.empty()) {
        tell("note: " + taken);
    }
    model.provenance = fmt::format("foam {}; {}, {}; {}", version(), file.file.filename().string(), file.format,
                                   counts_text(kinds_in(model)));
    if (!arguments.into.empty()) {
        if (!writer.consumer.edits) {
            throw Error(ErrorCode::usage, fmt::format("{} writes whole files; remedy: without --into", writer.name));
        }
        model.into = TextFile{arguments.into, text_of_file(arguments.into)};
    }
    if (lists_pairs(writer, parameters, !arguments.into.empty()) && original && model.groups.size() > 1) {
        model.ignored_pairs = ignored_pairs_of(model, &stop_on_interrupt());
    }
    if (writer.consumer.rest_pose) {
        const std::string sentence = give_rest_pose(
            model, model.into ? group_states(model.into->text, model.into->file.string()) : std::vector<GroupState>{});
        if (!sentence.empty()) {
            tell("note: " + sentence);
        }
    }
    return model;
}

/// Writes the files, those beside the one first. Throws Error(usage) if they replace inputs or, without --force,
/// others.
void write_files(const std::vector<WrittenFile>& files, const Original* original, const ConvertArguments& arguments,
                 bool in_place) {
    std::vector<std::filesystem::path> inputs{arguments.robot};
    if (original) {
        inputs = files_beside(*original->robot);
        inputs.emplace_back(arguments.robot);
    }
    if (!in_place) {
        inputs.emplace_back(arguments.model);
        inputs.emplace_back(arguments.into);
    }
    refuse_replacing(files, inputs, arguments.force);
    for (std::size_t i = files.size(); i-- > 0;) {
        make_folder_of(files[i]);
        write_whole_file(files[i].file, files[i].bytes);
    }
}

int convert(Program& program, const ConvertArguments& arguments) {
    const ThreadLimit limit(arguments.threads);
    const Registry& registry = program.registry();
    const Engine* engine = arguments.engine.empty() ? nullptr : &engine_named(arguments.engine);
    const RegisteredStage& format =
        writer_for(engine                     ? format_for(*engine, arguments.format, arguments.output, registry)
                   : arguments.format.empty() ? ending_of_output(arguments.output)
                                              : arguments.format,
                   registry);
    const bool in_place = is_same_file(arguments.into, arguments.output);
    for (const std::filesystem::path& target : files_of(format.info, arguments.output)) {
        refuse_overwriting(target, {arguments.model, arguments.robot, in_place ? "" : arguments.into},
                           arguments.force || in_place);
    }
    auto parameters = parameters_of(arguments.settings, format.info);
    if (engine && asks_for_engine(format.info, *engine)) {
        parameters.emplace("engine", std::string(engine->name));
    }
    const auto writer = registry.make<Writer>(format.info.name, parameters);
    // A file that gets its own spheres keeps its buffer.
    SphereFile file =
        read_sphere_file(arguments.model, registry, arguments.reader,
                         is_same_file(arguments.into, arguments.model) ? Radii::as_written : Radii::as_used,
                         program.standard_input.name_of(arguments.model));
    for (const std::string& note : file.notes) {
        tell(fmt::format("warning: {}: {}", arguments.model, note));
    }
    require_renames(arguments.renames, {&file});
    rename_links(file, renames_of(arguments.renames));
    const RobotChoices choices = choices_of(arguments.options);
    std::optional<Original> original;
    if (!arguments.robot.empty()) {
        original = load_original(arguments.robot, registry,
                                 {.links = choices.keep,
                                  .geometry = covered_geometry(arguments.options.geometry),
                                  .covers = covers_named(arguments.covers),
                                  .package_path = package_path_of(arguments.packages),
                                  .name = program.standard_input.name_of(arguments.robot),
                                  .skip = choices.skip});
    }
    const Original* known = original ? &*original : nullptr;
    name_only_link(file, known);
    if (original) {
        require_links(file, *original->robot);
    }
    keep_chosen(file, choices, known);
    if (!arguments.options.pad.empty()) {
        pad_and_tell(file, arguments.options, known);
    }
    for (const std::string& setting : arguments.settings) {
        question_setting(setting, format.info, known ? size_of(*known) : 0);
    }
    const SphereModel model = model_of(file, known, arguments, format.info, parameters);
    Telling context(arguments.verbose);
    const auto [files, proof] = judged_files(*writer, format.info, model, known, file, arguments.output, context);
    write_files(files, known, arguments, in_place);
    const KindCounts kinds = kinds_in(model);
    const bool elsewhere = format.info.consumer.elements_optional && !spheres_alone(kinds);
    print(fmt::format("Read: {}, {}, {} of {}\nWritten: {} by {}\n{}{}{}.\n", arguments.model, file.format,
                      counts_text(kinds), counted(model.groups.size(), "link"), names_text(files),
                      format.info.name,
                      elsewhere ? "The file holds no elements, only their pairs of links. Of the elements: " : "",
                      elsewhere ? proof.front() : static_cast<char>(std::toupper(proof.front())), proof.substr(1)) +
          text_about_written(parameters, arguments.engine));
    return 0;
}

} // namespace

void add_convert(Program& program) {
    CLI::App* command = add_command(program, "convert", "Convert a sphere model to another program's format",
                                    "  foam convert robot_spheres.urdf -o spheres.json --format pyroki\n"
                                    "  foam convert franka.yml panda.urdf -o panda.xrdf --tool-frame panda_hand\n"
                                    "  foam convert model.csv panda.urdf --into my.yml --format curobo -o new.yml\n"
                                    "  foam convert model.json panda.urdf --pad 1cm -o padded.csv\n"
                                    "\n"
                                    "With the robot, foam proves the model on the numbers that it writes, and writes\n"
                                    "the pairs of links that need no check where the format has them.\n"
                                    "`foam formats` lists the formats.");
    auto arguments = std::make_shared<ConvertArguments>();
    command
        ->add_option("model", arguments->model, "The sphere model, in any format that is read; - is the standard input")
        ->type_name("MODEL")
        ->required();
    command->add_option("robot", arguments->robot, "The robot, a URDF; some formats need it")->type_name("ROBOT");
    program.standard_input.may_be(arguments->model, StandardInput::Holds::model);
    program.standard_input.may_be(arguments->robot, StandardInput::Holds::geometry);
    program.standard_input.add_format(*command);
    command->add_option("-o,--output", arguments->output, "Output file; its extension selects the format")
        ->type_name("FILE")
        ->required();
    command->add_option("--format", arguments->format, "Format of the output: curobo, xrdf, srdf, mjcf, pyroki, …")
        ->type_name("FORMAT");
    add_engine(*command, arguments->engine);
    add_packages(*command, arguments->packages);
    add_reader(*command, arguments->reader);
    add_covers(*command, arguments->covers,
               "What is asked of the elements: solid, with the inside of what is closed, or surface alone");
    command->add_option("--into", arguments->into, "Copy this file to the output, with its spheres replaced")
        ->type_name("FILE");
    using enum RobotOption;
    add_robot_options(*command, arguments->options, {geometry, keep, skip, RobotOption::pad, lock, tool_frame});
    command->add_option("--base-link", arguments->base_link, "The link that the robot stands on; default: the root")
        ->type_name("LINK");
    command->add_option("--pose", arguments->pose, "Rest position of a joint, rad or m; repeatable")
        ->type_name("JOINT=VALUE")
        ->expected(1)
        ->take_all();
    command
        ->add_option("--rename", arguments->renames,
                     "Rename links of MODEL: the name or prefix OLD becomes NEW; '=LINK' for spheres without a link "
                     "name; repeatable")
        ->type_name("OLD=NEW")
        ->expected(1)
        ->take_all();
    command->add_option("--set", arguments->settings, "A parameter of the writer, e.g. version=0.7; repeatable")
        ->type_name("KEY=VALUE")
        ->expected(1)
        ->take_all();
    add_force(*command, arguments->force);
    command->add_flag("-v,--verbose", arguments->verbose, "Also print notes of the writer, not only warnings");
    add_threads(*command, arguments->threads);
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return convert(program, *arguments); }; });
}

} // namespace foam::cli
