#include "robot_options.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::cli {
namespace {

/// A row of the table. One of the members is where the texts go.
struct Row {
    RobotOption option;
    const char *name, *type, *text;
    std::vector<std::string> RobotOptions::*texts = nullptr; ///< repeatable
    std::string RobotOptions::*single = nullptr;
};

const Row rows[] = {
    {RobotOption::keep, "--keep", "GLOB",
     "Work only on links that match; the others keep their geometry; repeatable", &RobotOptions::keep},
    {RobotOption::skip, "--skip", "GLOB", "Leave out links that match: they keep their geometry; repeatable",
     &RobotOptions::skip},
    {RobotOption::weight, "--weight", "GLOB=NUMBER",
     "Factor of the excess volume of links that match, when elements are allocated: with more they get more; "
     "repeatable",
     &RobotOptions::weights},
    {RobotOption::lock, "--lock", "JOINT=VALUE", "A joint that stands still, and its position, rad or m; repeatable",
     &RobotOptions::locks},
    {RobotOption::tool_frame, "--tool-frame", "LINK",
     "A link that a planner moves to a goal, for formats of planners; default: the tip of a robot with one; repeatable",
     &RobotOptions::tool_frames},
    {RobotOption::pad, "--pad", "M", "Add a length to all radii: 1cm, 10mm, or a number of metres", nullptr,
     &RobotOptions::pad},
    {RobotOption::geometry, "--geometry", "WHICH",
     "The geometry of a robot that elements cover and are judged by: collision, visual, both or collision-or-visual",
     nullptr,
     &RobotOptions::geometry},
};

const Row& row_of(RobotOption option) {
    return *std::find_if(std::begin(rows), std::end(rows), [&](const Row& row) { return row.option == option; });
}

std::vector<std::string> globs_of(const std::vector<std::string>& texts, const char* option) {
    if (std::any_of(texts.begin(), texts.end(), [](const std::string& text) { return text.empty(); })) {
        throw Error(ErrorCode::usage, fmt::format("{} expects a name, in which * and ? stand for any characters, got ''",
                                                  option));
    }
    return texts;
}

std::vector<std::pair<std::string, double>> weights_of(const std::vector<std::string>& texts) {
    std::vector<std::pair<std::string, double>> weights;
    for (const std::string& text : texts) {
        const std::size_t equals = text.rfind('=');
        const auto weight = equals == text.npos ? std::nullopt : parse_number(text.substr(equals + 1));
        const std::string glob = text.substr(0, equals);
        if (!weight || glob.empty()) {
            throw Error(ErrorCode::usage,
                        fmt::format("--weight expects GLOB=NUMBER, such as 'hand*=3', got '{}'", shown(text)));
        }
        require_weight(*weight, text);
        if (std::any_of(weights.begin(), weights.end(), [&](const auto& known) { return known.first == glob; })) {
            throw Error(ErrorCode::usage, fmt::format("--weight is given twice for '{}'; remedy: once", shown(glob)));
        }
        weights.emplace_back(glob, *weight);
    }
    return weights;
}

} // namespace

void add_robot_options(CLI::App& command, RobotOptions& options, std::initializer_list<RobotOption> which) {
    for (const RobotOption wanted : which) {
        const Row& row = row_of(wanted);
        if (row.texts) {
            command.add_option(row.name, options.*row.texts, row.text)->type_name(row.type)->expected(1)->take_all();
            continue;
        }
        CLI::Option* option = command.add_option(row.name, options.*row.single, row.text)->type_name(row.type);
        if (wanted == RobotOption::geometry) {
            option->check(CLI::IsMember(words_of_covered_geometry()).description(""))->capture_default_str();
        }
    }
}

RobotChoices choices_of(const RobotOptions& options) {
    return {.keep = globs_of(options.keep, "--keep"),
            .skip = globs_of(options.skip, "--skip"),
            .weights = weights_of(options.weights),
            .locks = positions_of(options.locks, "--lock"),
            .tool_frames = globs_of(options.tool_frames, "--tool-frame")};
}

std::optional<QuickLength> pad_of(const RobotOptions& options) {
    if (options.pad.empty()) {
        return std::nullopt;
    }
    const double padding = length_of(options.pad, "--pad");
    if (!(padding >= 0)) {
        throw Error(ErrorCode::usage, fmt::format("--pad expects a length of at least 0, got '{}'", options.pad));
    }
    return QuickLength(padding, !parse_number(options.pad));
}

CoveredGeometry covered_geometry(const std::string& word) {
    const std::vector<std::string>& words = words_of_covered_geometry();
    return static_cast<CoveredGeometry>(std::find(words.begin(), words.end(), word) - words.begin());
}

JointValues positions_of(const std::vector<std::string>& texts, const char* option) {
    JointValues values;
    for (const std::string& text : texts) {
        const std::size_t equals = text.rfind('=');
        const auto value = equals == text.npos ? std::nullopt : parse_number(text.substr(equals + 1));
        if (!value || equals == 0) {
            throw Error(ErrorCode::usage,
                        fmt::format("{} expects JOINT=NUMBER, in rad or m, got '{}'", option, shown(text)));
        }
        if (!values.emplace(text.substr(0, equals), *value).second) {
            throw Error(ErrorCode::usage, fmt::format("{} is given twice for joint '{}'; remedy: once", option,
                                                      shown(text.substr(0, equals))));
        }
    }
    return values;
}

void question_length(const std::string& option, const std::string& text, double size, std::string_view of) {
    const std::optional<double> plain = parse_number(text);
    if (const std::string question = plain ? question_about({option, *plain}, size, of) : ""; !question.empty()) {
        tell("warning: " + question);
    }
}

} // namespace foam::cli
