#include "input/inputs.hpp"

#include <foam/base/error.hpp>
#include <foam/robot/held_joints.hpp>
#include <foam/yaml/findings.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline runtime {
namespace {

class Names {
public:
    Names(const Recipe& recipe, const Robot& robot) : recipe_(recipe), robot_(robot) {
        for (const Link& link : robot.links) {
            links_.push_back(link.name);
        }
        for (const Joint& joint : robot.joints) {
            joints_.push_back(joint.name);
        }
    }

    void check_link(const LinkOverride& link) {
        const auto matches = [&](const std::string& name) {
            return link.glob == name || glob_matches(link.glob, name);
        };
        if (std::any_of(links_.begin(), links_.end(), matches)) {
            return;
        }
        const bool glob = link.glob.find_first_of("*?[") != std::string::npos;
        const auto level = glob && !recipe_.strict ? Diagnostic::Level::warning : Diagnostic::Level::error;
        add(level, link.where, "unknown-link",
            fmt::format("{} in 'links' names no link of {}{}", yaml::in_quotes(link.glob), robot_text(),
                        yaml::suggestion(link.glob, links_)));
    }

    void check_links(const std::vector<std::string>& names, const Location& where, const char* key) {
        for (const std::string& name : names) {
            if (std::find(links_.begin(), links_.end(), name) == links_.end()) {
                add(Diagnostic::Level::error, where, "unknown-link",
                    fmt::format("{} in '{}' names no link of {}{}", yaml::in_quotes(name), key, robot_text(),
                                yaml::suggestion(name, links_)));
            }
        }
    }

    void check_pose(const JointValues& pose, const Location& where, const char* key) {
        for (const auto& [name, value] : pose) {
            if (std::find(joints_.begin(), joints_.end(), name) == joints_.end()) {
                add(Diagnostic::Level::error, where, "unknown-joint",
                    fmt::format("{} in '{}' names no joint of {}{}", yaml::in_quotes(name), key, robot_text(),
                                yaml::suggestion(name, joints_)));
            }
        }
    }

    void check_held(const JointValues& held, const Location& where, const char* key) {
        for (const auto& [joint, position] : held) {
            if (const std::string why = why_not_held(robot_, joint, position); !why.empty()) {
                add(Diagnostic::Level::error, where, "not-held", fmt::format("'{}': {}", key, why));
            }
        }
    }

    std::vector<Diagnostic> findings;

private:
    std::string robot_text() const { return robot_.file.filename().string(); }

    void add(Diagnostic::Level level, const Location& where, const char* code, std::string message) {
        Diagnostic& finding = findings.emplace_back();
        finding.level = level;
        finding.where = where;
        finding.code = code;
        finding.message = std::move(message);
    }

    const Recipe& recipe_;
    const Robot& robot_;
    std::vector<std::string> links_, joints_;
};

} // namespace

std::vector<Diagnostic> unknown_names(const Recipe& recipe, const Robot& robot) {
    Names names(recipe, robot);
    for (const LinkOverride& link : recipe.links) {
        names.check_link(link);
    }
    names.check_pose(recipe.self_collision_pose, recipe.self_collision_where, "self_collision.pose");
    const RobotFacts& facts = recipe.facts;
    names.check_links(facts.tool_frames, recipe.facts_where, "robot.tool_frames");
    names.check_links(facts.base_link.empty() ? std::vector<std::string>{} : std::vector{facts.base_link},
                      recipe.facts_where, "robot.base_link");
    names.check_held(facts.lock_joints, recipe.facts_where, "robot.lock_joints");
    names.check_pose(facts.default_pose, recipe.facts_where, "robot.default_pose");
    names.check_pose(recipe.pose, recipe.pose_where, "snapshots.pose");
    return std::move(names.findings);
}

void require_names(const std::vector<Diagnostic>& findings) {
    std::vector<std::string> errors;
    for (const Diagnostic& finding : findings) {
        if (finding.level == Diagnostic::Level::error) {
            errors.push_back(finding.text());
        }
    }
    if (!errors.empty()) {
        throw Error(ErrorCode::recipe, fmt::format("{}", fmt::join(errors, "\n")));
    }
}

} // namespace foam::runtime
