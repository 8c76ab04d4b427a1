#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/stage.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace foam::inline sdk {

/// Returns the rest pose of all files: that of the facts, with held joints where they are held.
static std::vector<double> rest_configuration(const SphereModel& model, const Kinematics& kinematics) {
    JointValues values = model.facts.default_pose;
    for (const auto& [joint, position] : model.facts.lock_joints) {
        values[joint] = position;
    }
    try {
        return kinematics.configuration(values);
    } catch (const Error& error) {
        throw Error(ErrorCode::output, fmt::format("lock_joints or default_pose: {}", error.what()));
    }
}

PlannedJoints planned_joints(const SphereModel& model) {
    const Kinematics kinematics(model.robot);
    const std::vector<double> configuration = rest_configuration(model, kinematics);
    PlannedJoints joints;
    for (std::size_t i = 0; i < configuration.size(); ++i) {
        const std::string& name = kinematics.freedoms()[i].joint;
        (model.facts.lock_joints.contains(name) ? joints.locked : joints.active).emplace_back(name, configuration[i]);
    }
    return joints;
}

std::map<std::string, Pose> placed_links(const SphereModel& model) {
    std::map<std::string, Pose> result;
    if (!model.robot || model.robot->joints.empty()) {
        return result;
    }
    const Kinematics kinematics(model.robot);
    const std::vector<Pose> poses = kinematics.link_poses(rest_configuration(model, kinematics));
    for (std::size_t i = 0; i < poses.size(); ++i) {
        result[model.robot->links[i].name] = poses[i];
    }
    return result;
}

/// Throws Error(output) for a link that the robot does not have.
static void require_link(const SphereModel& model, const std::string& link, const char* fact) {
    std::vector<std::string> known;
    for (const Link& other : model.robot->links) {
        known.push_back(other.name);
    }
    if (!model.robot->find_link(link)) {
        const std::string near = nearest_word(link, known);
        throw Error(ErrorCode::output, fmt::format("{}: the robot has no link '{}'{}", fact, shown(link),
                                                   near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
}

bool has_only_names(const Robot& robot) {
    return robot.joints.empty() && std::all_of(robot.links.begin(), robot.links.end(), [](const Link& link) {
               return link.collisions.empty() && link.visuals.empty();
           });
}

void require_robot(const SphereModel& model, const std::string& writer) {
    if (!model.robot || has_only_names(*model.robot)) {
        throw Error(ErrorCode::output,
                    fmt::format("{} needs the robot, not only its spheres; remedy: give its URDF", writer));
    }
}

const std::string& base_link(const SphereModel& model) {
    if (model.facts.base_link.empty()) {
        return model.robot->root;
    }
    require_link(model, model.facts.base_link, "base_link");
    return model.facts.base_link;
}

/// Returns the names of the tips, of many the first few: a tool frame is often one of them, or above them.
static std::string tips_text(const Robot& robot) {
    constexpr std::size_t most = 6;
    std::vector<std::string> tips = tips_of(robot);
    std::transform(tips.begin(), tips.end(), tips.begin(), [](const std::string& tip) { return shown(tip); });
    const bool more = tips.size() > most;
    tips.resize(std::min(tips.size(), most));
    return fmt::format("{}{}", fmt::join(tips, ", "), more ? ", …" : "");
}

/// Returns what to do for a writer without tool frames.
static std::string without_tool_frames(const std::string& writer, const Robot* robot) {
    return fmt::format("{} needs the links that a planner moves to a goal{}; remedy: --tool-frame LINK, robot: "
                       "{{tool_frames: [LINK]}} in the recipe, or tool_frames=[\"LINK\"] in Python",
                       writer, robot ? "; the last links of the robot are " + tips_text(*robot) : "");
}

std::string give_tool_frame(RobotFacts& facts, const Robot& robot, const StageInfo& writer, bool into) {
    if (into || !writer.consumer.tool_frames || !facts.tool_frames.empty() || has_only_names(robot)) {
        return "";
    }
    const std::vector<std::string> tips = tips_of(robot);
    if (tips.size() != 1) {
        throw Error(ErrorCode::usage, without_tool_frames(writer.name, &robot));
    }
    facts.tool_frames = tips;
    return sentence_about_tool_frame(tips.front());
}

std::string sentence_about_tool_frame(const std::string& tip) {
    return fmt::format("the tool frame is '{}', the only tip of the robot; another: --tool-frame LINK", shown(tip));
}

const std::vector<std::string>& require_tool_frames(const SphereModel& model, const std::string& writer) {
    if (model.facts.tool_frames.empty()) {
        throw Error(ErrorCode::output, without_tool_frames(writer, model.robot.get()));
    }
    for (const std::string& frame : model.facts.tool_frames) {
        require_link(model, frame, "tool_frames");
    }
    return model.facts.tool_frames;
}

} // namespace foam::inline sdk
