// foam view: robots and sphere models in a browser.
#include "commands.hpp"
#include "judge.hpp"

#include "cli/files.hpp"
#include "cli/messages.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/view/scene.hpp>
#include <foam/view/server.hpp>

#include <fmt/format.h>

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <thread>

namespace foam::cli {
namespace {

struct ViewArguments {
    std::vector<std::string> models, renames, packages;
    std::vector<std::size_t> counts;
    RobotOptions robot;
    std::string reader, srdf, html;
    MeshUnit unit;
    std::size_t threads = 0;
    int port = 0;
    bool no_open = false, force = false;
};

SubjectOptions subject_options(const Program& program, const ViewArguments& arguments) {
    SubjectOptions options{.files = {arguments.models.begin(), arguments.models.end()},
                           .renames = renames_of(arguments.renames),
                           .reader = arguments.reader,
                           .unit = arguments.unit,
                           .package_path = package_path_of(arguments.packages),
                           .geometry = covered_geometry(arguments.robot.geometry),
                           .srdf = arguments.srdf,
                           .nameless = program.standard_input.file(),
                           .nameless_name = program.standard_input.name(),
                           .choices = choices_of(arguments.robot)};
    return options;
}

bool has_spheres(const ViewedModel& model) {
    return std::any_of(model.spheres.begin(), model.spheres.end(), [](const auto& link) { return !link.empty(); });
}

/// Returns the counts of spheres that a page which is one file offers for a robot without a model: a few, since each is
/// a search of the whole robot.
std::vector<std::size_t> few_counts(const ViewedRobot& robot) {
    const std::vector<std::size_t> all = candidate_counts(robot);
    std::vector<std::size_t> few;
    for (std::size_t i = 0; i < all.size(); i += 4) { // an octave has four
        few.push_back(all[i]);
    }
    return few;
}

/// Returns whether -n searches for spheres of the model: it has none, and its robot's geometry is known.
bool is_searched(const Subject& subject, const ViewedModel& model) {
    return !has_spheres(model) && subject.robots[model.robot].judged;
}

/// Throws Error(usage) if -n asks for what the page cannot show.
void check_counts(const ViewArguments& arguments, const Subject& subject) {
    if (arguments.counts.empty()) {
        return;
    }
    if (arguments.html.empty() && arguments.counts.size() > 1) {
        throw Error(ErrorCode::usage, "a served page has a slider over all numbers of spheres, and begins with one; "
                                      "remedy: one -n, or --html FILE for a page with these numbers");
    }
    const auto searched = [&](const ViewedModel& model) { return is_searched(subject, model); };
    if (std::any_of(subject.models.begin(), subject.models.end(), searched)) {
        return;
    }
    if (std::none_of(subject.models.begin(), subject.models.end(), has_spheres)) {
        throw Error(ErrorCode::usage,
                    "-n searches for spheres, but there is no geometry that they could cover; remedy: "
                    "leave out -n, or choose another --geometry");
    }
    throw Error(ErrorCode::usage, "-n searches for spheres of a robot that is given without a model, but a model is "
                                  "given; remedy: leave out -n, or the model; to see both, make the other with foam "
                                  "spherize and give its file, too");
}

/// Returns the model with its figures: spheres of its file, or of each count, which are sorted.
SceneModel scene_model(const Subject& subject, const ViewedModel& model, const SubjectOptions& options,
                       Registry& registry, const std::vector<std::size_t>& counts) {
    const ViewedRobot& robot = subject.robots[model.robot];
    SceneModel result{.name = model.file.filename().string(),
                      .format = model.format,
                      .robot = model.robot,
                      .steps = {},
                      .at = 0,
                      .ignored = {}};
    if (is_searched(subject, model)) {
        for (const std::size_t count : counts.empty() ? few_counts(robot) : counts) {
            result.steps.push_back({spheres_of(robot, options, registry, count, {}, &stop_on_interrupt()), {}, {}});
        }
        result.at = (result.steps.size() - 1) / 2;
    } else {
        result.steps.push_back({model.spheres, {}, {}});
    }
    if (!robot.judged) {
        result.ignored = ignored_pairs_of(robot, nullptr, result.steps[result.at].spheres, &stop_on_interrupt());
        return result;
    }
    const Original original = original_of(robot, options, registry);
    result.ignored = ignored_pairs_of(robot, &original, result.steps[result.at].spheres, &stop_on_interrupt());
    for (ModelStep& step : result.steps) {
        step.figures = figures_of(robot, original, step.spheres);
        step.verdicts = verdicts_of(robot, original, step.spheres);
    }
    return result;
}

int write_page(const ViewArguments& arguments, const Subject& subject, const SubjectOptions& options,
               Registry& registry) {
    refuse_overwriting(arguments.html, inputs_of(subject, options), arguments.force);
    const std::set<std::size_t> counts(arguments.counts.begin(), arguments.counts.end());
    std::vector<SceneModel> models;
    for (const ViewedModel& model : subject.models) {
        models.push_back(scene_model(subject, model, options, registry, {counts.begin(), counts.end()}));
    }
    write_whole_file(arguments.html, static_page(subject, models));
    tell(fmt::format("written: {}", arguments.html));
    return 0;
}

/// Opens an address with the program that the desktop has for it. Returns whether there is one.
bool open_in_browser(const std::string& address) {
    std::string program = "xdg-open", text = address;
    char* arguments[] = {program.data(), text.data(), nullptr};
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
    }
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID); // Ctrl+C ends foam, and not the browser
    pid_t child = 0;
    const bool started = posix_spawnp(&child, program.c_str(), &files, &attributes, arguments, environ) == 0;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return started;
}

/// Searches for spheres of the robots that are given without a model, if -n is given.
void search_first(Session& session, const std::vector<std::size_t>& counts) {
    const std::vector<ViewedModel>& models = session.subject().models;
    for (std::size_t m = 0; m < models.size() && !counts.empty(); ++m) {
        if (is_searched(session.subject(), models[m])) {
            session.apply({.kind = Edit::Kind::count, .model = m, .spheres = counts.front()}, session.version());
        }
    }
}

int serve(const ViewArguments& arguments, Subject subject, const SubjectOptions& options, Registry& registry) {
    Session session(std::move(subject), options, registry, std::filesystem::current_path());
    Server server(session, arguments.port, with_names);
    const std::jthread watch([&](const std::stop_token& ended) {
        while (!ended.stop_requested()) {
            if (interrupted()) {
                server.stop(); // again until serve() has ended, which may not have begun
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    });
    search_first(session, arguments.counts);
    print(fmt::format("{}\n", server.address()));
    if (!arguments.no_open && !open_in_browser(server.address())) {
        tell("there is no xdg-open that could open a browser; remedy: open the address");
    }
    tell("only this computer can read the page; Ctrl+C ends it");
    server.serve();
    return 0;
}

int view(Program& program, const ViewArguments& arguments) {
    const ThreadLimit limit(arguments.threads);
    Registry& registry = program.registry();
    const SubjectOptions options = subject_options(program, arguments);
    Subject subject = load_subject(options, registry);
    for (std::string& note : subject.notes) {
        note = with_names(std::move(note)); // the page shows it, too
        tell(fmt::format("warning: {}", note));
    }
    check_counts(arguments, subject);
    return arguments.html.empty() ? serve(arguments, std::move(subject), options, registry)
                                  : write_page(arguments, subject, options, registry);
}

} // namespace

void add_view(Program& program) {
    CLI::App* command = add_command(program, "view", "Show robots and models in a browser, and edit spheres",
                                    "  foam view robot.urdf                      the page searches for spheres\n"
                                    "  foam view robot.urdf a.urdf b.yaml        two models of it, side by side\n"
                                    "  foam view robot_spheres.urdf              a model alone: nothing is proved\n"
                                    "  foam view robot.urdf -n 40 --html robot.html\n"
                                    "  xacro arm.xacro | foam view -\n"
                                    "\n"
                                    "The page is served on 127.0.0.1 under a secret address, to this computer only.\n"
                                    "It saves to the folder that foam view was started in.");
    auto arguments = std::make_shared<ViewArguments>();
    command
        ->add_option(
            "models", arguments->models,
            "A robot (URDF, xacro, MJCF, SDF, USD) or a mesh, then models of it, spheres or other elements in any format "
            "that is read; or such a model alone; one may be -, the standard input")
        ->type_name("MODEL")
        ->required();
    program.standard_input.may_be(arguments->models, StandardInput::Holds::model);
    program.standard_input.add_format(*command);
    command
        ->add_option("-n,--spheres", arguments->counts,
                     "Search for at most N spheres of the whole robot, where no model of it is given; with --html "
                     "repeatable, for the page's slider")
        ->type_name("N")
        ->expected(1)
        ->take_all()
        ->check(whole_number(1, 1'000'000));
    command->add_option("--html", arguments->html, "Write the page to one file that needs no other, and serve nothing")
        ->type_name("FILE");
    add_force(*command, arguments->force);
    command->add_flag("--no-open", arguments->no_open, "Print the address, and open no browser");
    command->add_option("--port", arguments->port, "Port of the server; default: any that is free")
        ->type_name("N")
        ->check(whole_number(1, 65535));
    command->add_option("--srdf", arguments->srdf, "Take named poses from the group states of this SRDF")
        ->type_name("FILE");
    using enum RobotOption;
    add_robot_options(*command, arguments->robot, {geometry, keep, skip, weight, lock});
    add_packages(*command, arguments->packages);
    add_mesh_unit(*command, arguments->unit);
    add_reader(*command, arguments->reader);
    add_renames(*command, arguments->renames);
    add_threads(*command, arguments->threads);
    command->callback(
        [&program, arguments] { program.action = [&program, arguments] { return view(program, *arguments); }; });
}

} // namespace foam::cli
