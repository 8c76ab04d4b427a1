#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/held_joints.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline recipe {
namespace {

bool matches(const std::string& glob, const std::string& link) {
    return glob == link || glob_matches(glob, link);
}

bool matches_any(const std::vector<std::string>& globs, const std::string& link) {
    return std::any_of(globs.begin(), globs.end(), [&](const std::string& glob) { return matches(glob, link); });
}

/// Returns the name of the robot's file, or its own where it is of no file.
std::string name_of(const Robot& robot) {
    return shown(robot.file.empty() ? robot.name : robot.file.filename().string());
}

std::vector<std::string> names_of_links(const Robot& robot) {
    std::vector<std::string> names;
    for (const Link& link : robot.links) {
        names.push_back(link.name);
    }
    return names;
}

/// Returns the name nearest to a glob: of names as long as its letters, at the begin or at the end; empty if none is
/// near enough to be a typing error.
std::string nearest_link(const std::string& glob, const std::vector<std::string>& names) {
    if (const std::string near = nearest_word(glob, names); !near.empty()) {
        return near;
    }
    std::string letters = glob;
    std::erase_if(letters, [](char c) { return c == '*' || c == '?' || c == '[' || c == ']'; });
    std::vector<std::string> parts;
    for (const std::string& name : names) {
        const std::size_t length = std::min(letters.size(), name.size());
        parts.push_back(glob.starts_with('*') ? name.substr(name.size() - length) : name.substr(0, length));
    }
    const std::string near = letters.empty() ? "" : nearest_word(letters, parts);
    const auto part = std::find(parts.begin(), parts.end(), near);
    return near.empty() ? "" : names[static_cast<std::size_t>(part - parts.begin())];
}

/// Returns "; did you mean 'hand'?", or the links that there are, of many the first few.
std::string instead_of(const std::string& glob, const std::vector<std::string>& names) {
    constexpr std::size_t most = 6;
    if (const std::string near = nearest_link(glob, names); !near.empty()) {
        return fmt::format("; did you mean '{}'?", shown(near));
    }
    std::vector<std::string> first = names;
    first.resize(std::min(most, names.size()));
    std::transform(first.begin(), first.end(), first.begin(), [](const std::string& name) { return shown(name); });
    return fmt::format("; there are: {}{}", fmt::join(first, ", "), names.size() > most ? ", …" : "");
}

void require_globs(const std::vector<std::string>& globs, const Robot& robot, const std::string& option) {
    const std::vector<std::string> names = names_of_links(robot);
    for (const std::string& glob : globs) {
        if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return matches(glob, name); })) {
            throw Error(ErrorCode::usage, fmt::format("{} '{}' matches no link of {}{}", option, shown(glob),
                                                      name_of(robot), instead_of(glob, names)));
        }
    }
}

void require_tool_frames(const RobotChoices& choices, const Robot& robot, const std::string& dashes) {
    const std::vector<std::string> names = names_of_links(robot);
    for (const std::string& frame : choices.tool_frames) {
        if (!robot.find_link(frame)) {
            throw Error(ErrorCode::usage, fmt::format("{}tool{}frame '{}' names no link of {}{}", dashes,
                                                      dashes.empty() ? "_" : "-", shown(frame),
                                                      name_of(robot), instead_of(frame, names)));
        }
    }
}

} // namespace

bool is_chosen(const RobotChoices& choices, const std::string& link) {
    return (choices.keep.empty() || matches_any(choices.keep, link)) && !matches_any(choices.skip, link);
}

void require_choices(const RobotChoices& choices, const Robot& robot, const char* dashes) {
    std::vector<std::string> weighed;
    for (const auto& [glob, weight] : choices.weights) {
        weighed.push_back(glob);
    }
    require_globs(choices.keep, robot, fmt::format("{}keep", dashes));
    require_globs(choices.skip, robot, fmt::format("{}skip", dashes));
    require_globs(weighed, robot, fmt::format("{}weight", dashes));
    if (std::none_of(robot.links.begin(), robot.links.end(),
                     [&](const Link& link) { return is_chosen(choices, link.name); })) {
        throw Error(ErrorCode::usage,
                    fmt::format("{0}keep and {0}skip leave no link of {1}; remedy: skip fewer", dashes, name_of(robot)));
    }
    for (const auto& [joint, position] : choices.locks) {
        if (const std::string why = why_not_held(robot, joint, position); !why.empty()) {
            throw Error(ErrorCode::usage, fmt::format("{}lock: {}", dashes, why));
        }
    }
    require_tool_frames(choices, robot, dashes);
}

void require_weight(double weight, const std::string& text, const char* dashes) {
    constexpr double largest = 1e6;
    if (!(weight > 0 && weight <= largest)) {
        throw Error(ErrorCode::usage, fmt::format("{}weight expects a factor above 0 and at most 1000000, got '{}'; "
                                                  "remedy: {}skip for links that get no elements",
                                                  dashes, shown(text), dashes));
    }
}

} // namespace foam::inline recipe
