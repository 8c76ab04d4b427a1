// foam self-collision: which pairs of links never need a check.
#include "cli/files.hpp"
#include "cli/messages.hpp"
#include "cli/program.hpp"
#include "commands.hpp"
#include "execute.hpp"
#include "judge.hpp"

#include <foam/base/error.hpp>
#include <foam/base/file.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/collision/reference_pose.hpp>
#include <foam/judge/judge_json.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <set>

namespace foam::cli {
namespace {

using Json = nlohmann::ordered_json;

struct SelfCollisionArguments {
    std::string urdf, model, reader, srdf, curobo, against;
    std::vector<std::string> renames, pose, packages;
    RobotOptions robot;
    std::size_t spheres = 32, threads = 0;
    SelfCollisionOptions options;
    bool json = false, force = false;
};

/// Returns the robot with the spheres of --model, or with its own and certified ones.
CollisionModel model_of_robot(const Program& program, const SelfCollisionArguments& arguments,
                              const Registry& registry) {
    const StandardInput& piped = program.standard_input;
    const std::filesystem::path given = arguments.urdf;
    const RobotChoices choices = choices_of(arguments.robot);
    const OriginalOptions options{.links = choices.keep,
                                  .geometry = covered_geometry(arguments.robot.geometry),
                                  .package_path = package_path_of(arguments.packages),
                                  .name = piped.is(arguments.urdf) ? piped.name() : given,
                                  .skip = choices.skip,
                                  .held = choices.locks};
    if (arguments.model.empty()) {
        return load_collision_model(arguments.urdf, registry, arguments.spheres, options);
    }
    const Original original = load_original(arguments.urdf, registry, options);
    refuse_mesh(*original.loaded);
    return collision_model_of(original, match(original,
                                              read_sphere_file(arguments.model, registry, arguments.reader,
                                                               Radii::as_used, piped.name_of(arguments.model)),
                                              renames_of(arguments.renames)));
}

CollisionModel model_of(Program& program, const SelfCollisionArguments& arguments) {
    CollisionModel model = model_of_robot(program, arguments, program.registry());
    for (const std::string& note : model.notes) {
        tell(fmt::format("warning: {}: {}", arguments.urdf, note));
    }
    return model;
}

/// Throws Error(usage) for a joint that the robot does not have.
void require_joints(const JointValues& pose, const Robot& robot) {
    std::vector<std::string> joints;
    for (const Joint& joint : robot.joints) {
        joints.push_back(joint.name);
    }
    for (const auto& [name, value] : pose) {
        if (std::find(joints.begin(), joints.end(), name) == joints.end()) {
            const std::string near = nearest_word(name, joints);
            throw Error(ErrorCode::usage,
                        fmt::format("--pose: {} has no joint '{}'{}", robot.file.string(), shown(name),
                                    near.empty() ? "" : fmt::format("; did you mean '{}'?", shown(near))));
        }
    }
}

std::size_t count(const CollisionModel& model, CollisionModel::Source source) {
    return static_cast<std::size_t>(std::count(model.sources.begin(), model.sources.end(), source));
}

std::string model_text(const SelfCollisionArguments& arguments, const CollisionModel& model) {
    using Source = CollisionModel::Source;
    const std::size_t given = count(model, Source::geometry), covers = count(model, Source::cover);
    if (!arguments.model.empty()) {
        return fmt::format("the spheres of {}", arguments.model);
    }
    if (covers == 0) {
        return "its own spheres";
    }
    return fmt::format("certified models of at most {} for {}{}", counted(arguments.spheres, "sphere"),
                       counted(covers, "link"), given == 0 ? "" : fmt::format(", its own spheres for {}", given));
}

std::string percent(double share) {
    return fmt::format("{:.3g} %", 100 * share);
}

std::string summary(const SelfCollisionMatrix& matrix) {
    const std::size_t checked = matrix.count(PairReason::none), by_pose = matrix.count(PairReason::default_pose);
    const auto proved =
        std::count_if(matrix.pairs.begin(), matrix.pairs.end(), [](const LinkPair& pair) { return pair.proved; });
    std::string text =
        fmt::format("{}: {} adjacent, {} always touching, {}{} never touching; {} proved; {} to check.\n",
                    counted(matrix.pairs.size(), "pair"), matrix.count(PairReason::adjacent), matrix.count(PairReason::always),
                    by_pose > 0 ? fmt::format("{} touching in the pose, ", by_pose) : "",
                    matrix.count(PairReason::never), proved, checked);
    const auto sampled = std::count_if(matrix.pairs.begin(), matrix.pairs.end(), [](const LinkPair& pair) {
        return pair.reason == PairReason::never && !pair.proved;
    });
    if (sampled > 0) {
        text += fmt::format("Never by samples: at {:g} % confidence less than {} of the configurations for one pair, "
                            "{} for all {} such pairs at once.\n",
                            100 * matrix.confidence, percent(matrix.rate_bound()), percent(matrix.joint_rate_bound()),
                            sampled);
    }
    return text;
}

} // namespace

std::string evidence(const SelfCollisionMatrix& matrix, const LinkPair& pair) {
    if (pair.reason == PairReason::adjacent) {
        return "joined";
    }
    if (pair.proved) {
        return "proved";
    }
    if (pair.unbounded) {
        return "a planar or floating joint lies in between";
    }
    if (pair.geometry_samples == 1) {
        return fmt::format("no joint between them; the geometry {}",
                           pair.geometry_touching > 0 ? "touches" : "does not touch");
    }
    if (pair.samples == 0 && pair.reason == PairReason::never) {
        return fmt::format("the elements never touch, the geometry in 0 of {}: in less than {}", pair.geometry_samples,
                           percent(matrix.rate_bound(pair.geometry_samples)));
    }
    if (pair.samples == 0) {
        return "";
    }
    const std::string seen = fmt::format("touch in {} of {}", pair.touching, pair.samples);
    if (pair.found_touching) {
        return seen + ", and in a pose that a search found";
    }
    if (pair.reason == PairReason::never && pair.geometry_samples > 0) {
        return fmt::format("{}, the geometry in 0 of {}: in less than {}", seen, pair.geometry_samples,
                           percent(matrix.rate_bound(pair.geometry_samples)));
    }
    if (pair.reason == PairReason::never) {
        return fmt::format("{}: in less than {}", seen, percent(matrix.rate_bound(pair.samples)));
    }
    if (pair.reason == PairReason::always) {
        const std::size_t tested = pair.geometry_samples > 0 ? pair.geometry_samples : pair.samples;
        return fmt::format("geometry touches in {0} of {0}: in more than {1:.10g} %", tested,
                           100 * (1 - matrix.rate_bound(tested)));
    }
    if (pair.touches_by_elements_alone) {
        return fmt::format("{}, the geometry in {} of {}", seen, pair.geometry_touching, pair.geometry_samples);
    }
    return fmt::format("{}: {}", seen, percent(static_cast<double>(pair.touching) / static_cast<double>(pair.samples)));
}

namespace {

std::string table_of_pairs(const SelfCollisionArguments& arguments, const CollisionModel& model,
                           const SelfCollisionMatrix& matrix) {
    const std::vector<Link>& links = model.robot->links;
    std::size_t width = 5;
    for (const LinkPair& pair : matrix.pairs) {
        for (const std::size_t link : {pair.first, pair.second}) {
            width = std::max(width, shown_width(shown(links[link].name)));
        }
    }
    std::string text = fmt::format("{}: {}\n{:<{}}  {:<{}}  {:<8}  {}\n", arguments.urdf, model_text(arguments, model),
                                   "link", width, "link", width, "reason", "evidence");
    for (const LinkPair& pair : matrix.pairs) {
        text += fmt::format(
            "{}  {}  {:<8}  {}\n", padded(links[pair.first].name, width), padded(links[pair.second].name, width),
            pair.reason == PairReason::none ? "(check)" : to_string(pair.reason), evidence(matrix, pair));
    }
    return text + summary(matrix);
}

/// Warns of pairs that a planner can never move apart, though their geometry is apart.
void tell_touching_elements(const SelfCollisionMatrix& matrix, const Robot& robot) {
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.touches_by_elements_alone) {
            tell(fmt::format("warning: {}: {}", shown(robot.links[pair.first].name), sentence_about(pair, robot)));
        }
    }
}

/// Warns of the pairs that are left out because they touch in one pose.
void tell_left_out_by_pose(const SelfCollisionMatrix& matrix, const Robot& robot) {
    std::vector<std::string> pairs;
    for (const LinkPair& pair : matrix.pairs) {
        if (pair.reason == PairReason::default_pose) {
            pairs.push_back(fmt::format("{} and {}", shown(robot.links[pair.first].name),
                                        shown(robot.links[pair.second].name)));
        }
    }
    if (!pairs.empty()) {
        tell(fmt::format("warning: --by-pose leaves out pairs that touch in the given pose; contacts of these links in "
                         "other poses are missed: {}",
                         fmt::join(pairs, ", ")));
    }
}

/// Returns the reference pose: as given, a state of the SRDF that is compared, or one in which no links touch.
ReferenceConfiguration reference_of(const SelfCollisionArguments& arguments, const CollisionModel& model,
                                    const Kinematics& kinematics) {
    constexpr std::uintmax_t most_bytes = 64'000'000;
    std::vector<GroupState> states;
    if (!arguments.against.empty()) { // where it cannot be read, the comparison reports it
        states = group_states(read_regular_file(arguments.against, most_bytes, "").bytes, arguments.against);
    }
    return reference_configuration(
        kinematics, model.solids,
        {.given = arguments.options.reference, .named = states, .held = {}, .seed = arguments.options.seed});
}

/// Returns the matrix. Draws a bar on a terminal.
SelfCollisionMatrix matrix_of(const Kinematics& kinematics, const CollisionModel& model,
                              SelfCollisionOptions options, const ReferenceConfiguration& reference) {
    options.reference.clear();
    for (std::size_t i = 0; i < reference.configuration.size(); ++i) {
        options.reference[kinematics.freedoms()[i].joint] = reference.configuration[i];
    }
    Progress bar(false);
    const auto start = std::chrono::steady_clock::now();
    options.progress = [&](double share) {
        Event event;
        event.stage = "pairs of links";
        event.done = share;
        event.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        bar.on(event);
    };
    return self_collision_matrix(kinematics, model, options);
}

/// Pairs that are about another robot, or misspelt.
void tell_unknown_links(const Agreement& agreement, const Robot& robot) {
    std::set<std::string> unknown;
    for (const IgnoredPair& pair : agreement.unknown) {
        for (const std::string& name : {pair.first, pair.second}) {
            if (!robot.find_link(name)) {
                unknown.insert("'" + shown(name) + "'");
            }
        }
    }
    if (!unknown.empty()) {
        tell(fmt::format("warning: {}: names that are no link of {}: {}", agreement.file, robot.file.string(),
                         fmt::join(unknown, ", ")));
    }
}

int self_collision(Program& program, SelfCollisionArguments& arguments) {
    const ThreadLimit limit(arguments.threads);
    arguments.options.reference = positions_of(arguments.pose, "--pose");
    arguments.options.cancel = &stop_on_interrupt();
    for (const std::string& target : {arguments.srdf, arguments.curobo}) {
        refuse_overwriting(target, {arguments.urdf, arguments.model, arguments.against}, arguments.force);
    }
    const CollisionModel model = model_of(program, arguments);
    require_joints(arguments.options.reference, *model.robot);
    const Kinematics kinematics(model.robot);
    const ReferenceConfiguration reference = reference_of(arguments, model, kinematics);
    const SelfCollisionMatrix matrix = matrix_of(kinematics, model, arguments.options, reference);
    if (reference.source != ReferenceConfiguration::Source::zero) {
        tell((reference.touching.empty() ? "note: " : "warning: ") + sentence_about(kinematics, reference));
    }
    tell_touching_elements(matrix, *model.robot);
    tell_left_out_by_pose(matrix, *model.robot);
    if (!arguments.srdf.empty()) {
        write_whole_file(arguments.srdf, srdf_text(*model.robot, matrix));
    }
    if (!arguments.curobo.empty()) {
        write_whole_file(arguments.curobo, curobo_text(*model.robot, matrix));
    }
    Json json = json_of_matrix<Json>(arguments.urdf, model_text(arguments, model), arguments.options.seed, kinematics,
                                     model, matrix);
    std::string text = table_of_pairs(arguments, model, matrix);
    if (!arguments.against.empty()) {
        const Agreement found = agreement(arguments.against, *model.robot, matrix);
        tell_unknown_links(found, *model.robot);
        json["against"] = json_of(found, *model.robot);
        text += text_of(found, *model.robot, matrix);
    }
    if (arguments.json) {
        print_json(json);
    } else {
        print(text);
    }
    return 0;
}

void add_model_options(CLI::App& command, Program& program, SelfCollisionArguments& arguments) {
    command
        .add_option("robot", arguments.urdf,
                    "The robot, a URDF; its collision spheres are used as they are; - is the standard input")
        ->type_name("ROBOT")
        ->required();
    program.standard_input.may_be(arguments.urdf, StandardInput::Holds::geometry);
    program.standard_input.may_be(arguments.model, StandardInput::Holds::model);
    program.standard_input.add_format(command);
    add_packages(command, arguments.packages);
    command
        .add_option("--spheres", arguments.spheres,
                    "Maximum number of certified spheres that cover a link with other geometry, 1 to 1000")
        ->type_name("N")
        ->check(whole_number(1, 1000))
        ->capture_default_str();
    CLI::Option* model = command
                             .add_option("--model", arguments.model,
                                         "Spheres of the robot's links, in any format that `foam evaluate` reads")
                             ->type_name("MODEL");
    add_reader(command, arguments.reader)->needs(model);
    using enum RobotOption;
    add_robot_options(command, arguments.robot, {geometry, keep, skip, lock});
    add_renames(command, arguments.renames);
}

void add_sampling_options(CLI::App& command, SelfCollisionArguments& arguments) {
    SelfCollisionOptions& options = arguments.options;
    command
        .add_option("--samples", options.samples,
                    "Number of random configurations for pairs without a proof, at most 1000000000; 0: only proofs")
        ->type_name("N")
        ->check(whole_number(0, 1000000000))
        ->capture_default_str();
    command
        .add_option("--confidence", options.confidence,
                    "Confidence of the bound for pairs that no sample found in contact, in (0, 1)")
        ->type_name("C")
        ->check(number_between(0, 1))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Seed of the samples")
        ->type_name("N")
        ->check(whole_number())
        ->capture_default_str();
    CLI::Option* pose = command
                            .add_option("--pose", arguments.pose,
                                        "Joint position in the reference pose, in rad or m; others: zero, moved into "
                                        "the limits; default: a pose in which no links touch; repeatable")
                            ->type_name("JOINT=VALUE")
                            ->expected(1)
                            ->take_all();
    command
        .add_flag("--by-pose", options.by_pose,
                  "Also leave out the pairs whose geometry touches in the pose of --pose (Default); contacts of these "
                  "links in other poses are then missed")
        ->needs(pose);
    command
        .add_option(
            "--proof-boxes", options.proof_boxes,
            "Maximum number of boxes of joint positions in the proof for a pair, at most 1000000000; 0: no proofs")
        ->type_name("N")
        ->check(whole_number(0, 1000000000))
        ->capture_default_str();
}

} // namespace

void add_self_collision(Program& program) {
    CLI::App* command = add_command(program, "self-collision", "Find the pairs of links that need no collision check",
                                    "  foam self-collision panda_22.urdf --srdf panda.srdf   for MoveIt\n"
                                    "  foam self-collision panda.urdf --curobo ignore.yaml   for cuRobo\n"
                                    "  foam self-collision panda.urdf --model franka.yml --json\n"
                                    "  foam self-collision panda.urdf --against panda.srdf   differences and reasons\n"
                                    "  foam self-collision panda.urdf --samples 1000000 --confidence 0.99\n"
                                    "\n"
                                    "Reasons why a pair needs no check:\n"
                                    "  Adjacent  at most one movable joint lies between the links\n"
                                    "  Always    their geometry touches in every configuration\n"
                                    "  Default   they touch in the given pose; with --by-pose alone\n"
                                    "  Never     they touch in no configuration\n"
                                    "foam proves Always and Never, or prints a bound from random samples. All other\n"
                                    "pairs need a check.");
    auto arguments = std::make_shared<SelfCollisionArguments>();
    add_model_options(*command, program, *arguments);
    add_sampling_options(*command, *arguments);
    command->add_option("--srdf", arguments->srdf, "Write the pairs as an SRDF, <disable_collisions>")
        ->type_name("FILE");
    command->add_option("--curobo", arguments->curobo, "Write the pairs as cuRobo's self_collision_ignore (YAML)")
        ->type_name("FILE");
    command
        ->add_option("--against", arguments->against,
                     "Compare the pairs with those that an SRDF, a cuRobo file or an XRDF excludes")
        ->type_name("FILE");
    add_force(*command, arguments->force);
    command->add_flag("--json", arguments->json, "Print the matrix as JSON");
    add_threads(*command, arguments->threads);
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return self_collision(program, *arguments); };
    });
}

} // namespace foam::cli
