// foam evaluate: every figure of a sphere model, anybody's.
#include "cli/messages.hpp"
#include "commands.hpp"
#include "judge.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/base/text.hpp>
#include <foam/collision/consequences.hpp>
#include <foam/geometry/clip_plane.hpp>
#include <foam/geometry/length.hpp>
#include <foam/runtime/shown_elements.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace foam::cli {

namespace {

constexpr std::size_t most_rows = 10;

std::string share(std::size_t count, std::size_t of) {
    return fmt::format("{:>9}  {:>6.2f} %", count,
                       of > 0 ? 100 * static_cast<double>(count) / static_cast<double>(of) : 0.0);
}

std::string more(std::size_t rows, const char* noun) {
    return rows > most_rows ? fmt::format("{} more {} (--json lists them)\n", rows - most_rows, noun) : "";
}

std::string pairs_text(const Robot& robot, const Consequences& found) {
    std::vector<PairConsequence> pairs;
    std::copy_if(found.pairs.begin(), found.pairs.end(), std::back_inserter(pairs),
                 [](const PairConsequence& pair) { return pair.missed > 0 || pair.false_contacts > 0; });
    std::stable_sort(pairs.begin(), pairs.end(), [](const PairConsequence& a, const PairConsequence& b) {
        return std::pair(a.missed, a.false_contacts) > std::pair(b.missed, b.false_contacts);
    });
    if (pairs.empty()) {
        return {};
    }
    const auto first = [&](const PairConsequence& pair) { return robot.links[pair.first].name; };
    const auto second = [&](const PairConsequence& pair) { return robot.links[pair.second].name; };
    const std::size_t width = std::max(column_width("link", pairs, first), column_width("link", pairs, second));
    std::string text = fmt::format("\n{:<{}}  {:<{}}  {:>8}  {:>8}  {:>8}\n", "link", width, "link", width, "contacts",
                                   "missed", "false");
    for (std::size_t i = 0; i < std::min(most_rows, pairs.size()); ++i) {
        const PairConsequence& pair = pairs[i];
        text +=
            fmt::format("{}  {}  {:>8}  {:>8}  {:>8}\n", padded(first(pair), width),
                        padded(second(pair), width), pair.contacts, pair.missed, pair.false_contacts);
    }
    return text + more(pairs.size(), "pairs");
}

std::string elements_text(const Robot& robot, const Consequences& found) {
    if (found.elements.empty()) {
        return {};
    }
    const auto name = [&](const ElementConsequence& element) { return robot.links[element.link].name; };
    const std::size_t width = column_width("link", found.elements, name);
    std::string text = fmt::format("\n{:<{}}  {:>8}  {:>8}\n", "link", width, "element", "false");
    for (std::size_t i = 0; i < std::min(most_rows, found.elements.size()); ++i) {
        const ElementConsequence& element = found.elements[i];
        text += fmt::format("{}  {:>8}  {:>8}\n", padded(name(element), width), element.element,
                            element.false_contacts);
    }
    return text + more(found.elements.size(), "elements");
}

/// Returns the counts of poses, and the pairs and elements with most false or missed contacts.
std::string poses_text(const Robot& robot, const Consequences& found) {
    std::string text = fmt::format("{}, {} of links\n", counted(found.poses, "pose"), counted(found.pairs.size(), "pair"));
    text += fmt::format("in contact       {}  the geometry of a pair touches\n", share(found.in_contact, found.poses));
    text += fmt::format("refused          {}  the model of a pair touches\n", share(found.refused, found.poses));
    text += fmt::format("falsely refused  {}  the model touches, no geometry does\n",
                        share(found.falsely_refused, found.poses));
    text += fmt::format("missed           {}  geometry touches, no model does\n", share(found.missed, found.poses));
    return text + pairs_text(robot, found) + elements_text(robot, found);
}

struct EvaluateArguments {
    JudgeOptions judge;
    std::string model;
    std::vector<std::string> clips;
    PoseOptions poses;
    std::uint64_t seed = 0;
    bool json = false;
};

bool in_poses(const EvaluateArguments& arguments) {
    return arguments.poses.random > 0 || !arguments.poses.file.empty();
}

std::string with_error(double value, double error, int digits) {
    return std::isfinite(value) ? fmt::format("{} ±{}", figure_text(value, digits), figure_text(error, digits)) : "inf";
}

std::string row(const std::string& name, std::size_t width, const Figures& figures, const std::string& certified) {
    const Measures& m = figures.measures;
    return fmt::format("{}  {:>7}  {:>13}  {:>9}  {:>13}  {:>13}  {:>9}  {:>9}  {:>9}\n", padded(name, width),
                       m.spheres, with_error(100 * m.covered, 100 * figures.covered_error, 2), millimetres(m.gap),
                       with_error(m.excess, m.excess_error, 3), with_error(m.missing, m.missing_error, 3),
                       millimetres(m.protrusion_max), millimetres(m.protrusion_mean), certified);
}

std::string table_of_figures(const Original& original, const Evaluation& evaluation, const char* noun,
                             const ProvedLinks& verdict) {
    const auto yes_or_no = [](const Figures& figures) { return figures.measures.certified ? "yes" : "no"; };
    const std::size_t width = column_width("total", original.links, &OriginalLink::link);
    std::string table =
        fmt::format("{:<{}}  {:>7}  {:>13}  {:>9}  {:>13}  {:>13}  {:>9}  {:>9}  {:>9}\n", "link", width, noun,
                    "covered %", "gap mm", "excess", "missing", "out max", "mean mm", "certified");
    bool bare = false;
    for (std::size_t i = 0; i < original.links.size(); ++i) {
        table += row(original.links[i].link, width, evaluation.links[i], yes_or_no(evaluation.links[i]));
        bare = bare || evaluation.links[i].measures.spheres == 0;
    }
    if (bare) {
        table += row(fmt::format("links with {}", noun), width, evaluation.with_spheres,
                     yes_or_no(evaluation.with_spheres));
    }
    return table + row("total", width, evaluation.total, certified_cell(verdict));
}

/// A plane of a link.
struct LinkPlane {
    std::size_t link = 0; ///< index
    ClipPlane plane;
};

/// LINK=NX,NY,NZ,OFFSET; throws Error(usage).
LinkPlane plane_of(const std::string& text, const Original& original) {
    const std::size_t equals = text.rfind('=');
    std::vector<std::optional<double>> numbers;
    for (std::size_t at = equals; at < text.size() && numbers.size() <= 4;) { // at '=' or ','
        const std::size_t end = std::min(text.find(',', at + 1), text.size());
        const std::string_view word = std::string_view(text).substr(at + 1, end - at - 1);
        numbers.push_back(numbers.size() < 3 ? parse_number(word) : parse_length(word));
        at = end;
    }
    LinkPlane result;
    const bool whole =
        numbers.size() == 4 && std::all_of(numbers.begin(), numbers.end(), [](const auto& n) { return n; });
    if (whole) {
        result.plane = {{*numbers[0], *numbers[1], *numbers[2]}, *numbers[3], 0};
    }
    if (!whole || !(norm(result.plane.normal) > 0)) {
        throw Error(ErrorCode::usage, fmt::format("--clip expects LINK=NX,NY,NZ,OFFSET with a normal that is not zero, "
                                                  "such as base=0,0,-1,5mm; got '{}'",
                                                  text));
    }
    const auto link = std::find_if(original.links.begin(), original.links.end(),
                                   [&](const OriginalLink& l) { return l.link == text.substr(0, equals); });
    if (link == original.links.end()) {
        throw Error(ErrorCode::usage,
                    fmt::format("--clip {}: there is no link '{}' to evaluate", text, text.substr(0, equals)));
    }
    result.link = static_cast<std::size_t>(link - original.links.begin());
    question_length("OFFSET of --clip", text.substr(text.rfind(',') + 1), size_of(original), "the robot");
    return result;
}

std::string planes_text(const std::vector<LinkPlane>& planes, const Original& original, const MatchedModel& model) {
    std::string text;
    for (const auto& [link, plane] : planes) {
        text += model.elements[link].empty()
                    ? fmt::format("{}: has no spheres\n", shown(original.links[link].link))
                    : fmt::format("{}: {} mm beyond the plane with {}\n", shown(original.links[link].link),
                                  millimetres(reached({plane}, model.elements[link]).front().reached, 3), text_of(plane));
    }
    return text;
}

nlohmann::ordered_json planes_json(const std::vector<LinkPlane>& planes, const Original& original,
                                   const MatchedModel& model) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& [link, plane] : planes) {
        json.push_back(
            {{"link", original.links[link].link},
             {"normal", {plane.normal.x, plane.normal.y, plane.normal.z}},
             {"offset_m", plane.offset},
             {"reached_m", json_number<nlohmann::ordered_json>(reached({plane}, model.elements[link]).front().reached)}});
    }
    return json;
}

int evaluate_spheres(Program& program, const EvaluateArguments& arguments) {
    const ThreadLimit limit(arguments.judge.threads);
    if (!arguments.judge.robot.locks.empty() && !in_poses(arguments)) {
        throw Error(ErrorCode::usage, "--lock holds joints in poses; remedy: --poses 1000");
    }
    const Original original = original_of(program, arguments.judge);
    std::vector<LinkPlane> planes;
    for (const std::string& text : arguments.clips) {
        planes.push_back(plane_of(text, original));
    }
    const MatchedModel model = model_of(program, arguments.judge, original, arguments.model);
    const Evaluation evaluation = evaluate(original, model, arguments.seed);
    std::optional<Consequences> consequences;
    if (in_poses(arguments)) {
        PoseOptions options = arguments.poses;
        options.seed = arguments.seed;
        consequences = judged_in_poses(original, model, options);
    }
    if (arguments.json) {
        nlohmann::ordered_json json{{"original", arguments.judge.original}, {"seed", arguments.seed}};
        json.update(json_of_evaluation<nlohmann::ordered_json>(original, model, evaluation));
        if (!planes.empty()) {
            json["clip"] = planes_json(planes, original, model);
        }
        if (consequences) {
            json["consequences"] = json_of_consequences<nlohmann::ordered_json>(*original.robot, *consequences);
        }
        print_json(json);
    } else {
        const KindCounts kinds = kinds_of_model(model);
        const ProvedLinks verdict = proved_links(original, model, evaluation);
        print(fmt::format("{} ({}): {} for {}\n", arguments.model, model.file.format, counts_text(kinds),
                          arguments.judge.original) +
              table_of_figures(original, evaluation, spheres_alone(kinds) ? "spheres" : "elements", verdict) +
              verdict_of(verdict) + not_judged_text(verdict) + planes_text(planes, original, model) +
              (consequences ? "\n" + poses_text(*original.robot, *consequences) : ""));
    }
    return 0;
}

void add_pose_options(CLI::App& command, PoseOptions& options) {
    CLI::Option* random =
        command
            .add_option(
                "--poses", options.random,
                "Count missed contacts and falsely refused poses in N random poses, at most 1000000, beside the "
                "original geometry")
            ->type_name("N")
            ->check(whole_number(1, 1000000));
    CLI::Option* given =
        command
            .add_option("--pose-file", options.file,
                        "Do so in the poses of FILE (YAML or JSON): a list of maps from joint to position, rad or m")
            ->type_name("FILE");
    command
        .add_option_function<std::string>(
            "--srdf",
            [&options, random, given](const std::string& file) {
                if (random->count() == 0 && given->count() == 0) {
                    throw Error(ErrorCode::usage, "--srdf excludes pairs of links in poses; remedy: --poses 1000");
                }
                options.ignored = file;
            },
            "Pairs of links that are not checked in poses: an SRDF, a cuRobo file or an XRDF; default: neighbours, and "
            "pairs whose geometry touches in every pose")
        ->type_name("FILE");
}

} // namespace

void add_evaluate(Program& program) {
    CLI::App* command = add_command(program, "evaluate", "Measure the quality of a model of spheres or other elements",
                                    "  foam evaluate robot.urdf robot_spheres.urdf\n"
                                    "  foam evaluate panda.urdf franka.yml --json    cuRobo, Lula, XRDF, MorphIt, …\n"
                                    "  foam evaluate part.stl part.json\n"
                                    "  foam evaluate iiwa.urdf drake.urdf --rename iiwa_link_=lbr_iiwa_link_\n"
                                    "  foam evaluate robot.urdf model.urdf --poses 1000   false and missed contacts\n"
                                    "\n"
                                    "foam recognises formats by the content of the file. Columns of the table:\n"
                                    "  covered    share of the surface inside the elements\n"
                                    "  gap        how far the geometry extends beyond the elements\n"
                                    "  excess     volume of the elements outside the link / volume of the link\n"
                                    "  missing    volume of the link outside the elements / volume of the link\n"
                                    "  out        how far the elements extend beyond the link\n"
                                    "  certified  gap = 0 is proved\n"
                                    "A number after ± is a standard error.");
    auto arguments = std::make_shared<EvaluateArguments>();
    add_judge_options(*command, program, arguments->judge);
    command->add_option("model", arguments->model, "The model, spheres or other elements; - is the standard input")
        ->type_name("MODEL")
        ->required();
    program.standard_input.may_be(arguments->model, StandardInput::Holds::model);
    command
        ->add_option(
            "--clip", arguments->clips,
            "Report how far the elements of LINK extend beyond the plane n · p = OFFSET of its frame, with the "
            "unit normal n along NX,NY,NZ; OFFSET in m or with a unit, e.g. 5mm; repeatable")
        ->type_name("LINK=NX,NY,NZ,OFFSET")
        ->expected(1)
        ->take_all();
    add_pose_options(*command, arguments->poses);
    add_robot_options(*command, arguments->judge.robot, {RobotOption::lock});
    command->add_option("--seed", arguments->seed, "Seed of the samples; default: 0")
        ->type_name("N")
        ->check(whole_number());
    command->add_flag("--json", arguments->json, "Print the figures as JSON, in metres instead of millimetres");
    command->callback([&program, arguments] {
        program.action = [&program, arguments] { return evaluate_spheres(program, *arguments); };
    });
}

} // namespace foam::cli
