#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/kinematics.hpp>
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

/// Returns a sentence about the links that no joint moves another link from: a tool frame is often one of them, or
/// above them. Names a few.
static std::string last_links(const Robot& robot) {
    constexpr std::size_t most = 4;
    std::vector<std::string> last;
    for (const Link& link : robot.links) {
        if (std::none_of(robot.joints.begin(), robot.joints.end(),
                         [&](const Joint& joint) { return joint.parent == link.name; })) {
            last.push_back(shown(link.name));
        }
    }
    const bool more = last.size() > most;
    last.resize(std::min(last.size(), most));
    return fmt::format("; the last links of the robot are {}{}", fmt::join(last, ", "), more ? ", …" : "");
}

const std::vector<std::string>& require_tool_frames(const SphereModel& model, const std::string& writer) {
    if (model.facts.tool_frames.empty()) {
        throw Error(
            ErrorCode::output,
            fmt::format("{} needs the links that a planner moves to a goal{}; remedy: --tool-frame LINK, robot: "
                        "{{tool_frames: [LINK]}} in the recipe, --set robot.tool_frames=[LINK], or "
                        "tool_frames=[\"LINK\"] in Python",
                        writer, model.robot ? last_links(*model.robot) : ""));
    }
    for (const std::string& frame : model.facts.tool_frames) {
        require_link(model, frame, "tool_frames");
    }
    return model.facts.tool_frames;
}

} // namespace foam::inline sdk
