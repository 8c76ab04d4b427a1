#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/planning.hpp>

#include <fmt/format.h>

namespace foam::inline sdk {

PlannedJoints planned_joints(const SphereModel& model) {
    const Kinematics kinematics(model.robot);
    JointValues given = model.facts.default_pose;
    for (const auto& [joint, position] : model.facts.lock_joints) {
        given[joint] = position;
    }
    std::vector<double> configuration;
    try {
        configuration = kinematics.configuration(given);
    } catch (const Error& error) {
        throw Error(ErrorCode::output, fmt::format("lock_joints or default_pose: {}", error.what()));
    }
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
    JointValues values = model.facts.default_pose;
    for (const auto& [joint, value] : model.facts.lock_joints) {
        values[joint] = value; // a held joint stands where it is held
    }
    const Kinematics kinematics(model.robot);
    const std::vector<Pose> poses = kinematics.link_poses(kinematics.configuration(values));
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

void require_robot(const SphereModel& model, const std::string& writer) {
    if (!model.robot || model.robot->source.empty()) {
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

const std::vector<std::string>& require_tool_frames(const SphereModel& model, const std::string& writer) {
    if (model.facts.tool_frames.empty()) {
        throw Error(ErrorCode::output,
                    fmt::format("{} needs the links that a planner moves to a goal; remedy: robot: {{tool_frames: "
                                "[LINK]}} in the recipe, --set robot.tool_frames=[LINK], --tool-frame LINK, or "
                                "tool_frames=[\"LINK\"] in Python",
                                writer));
    }
    for (const std::string& frame : model.facts.tool_frames) {
        require_link(model, frame, "tool_frames");
    }
    return model.facts.tool_frames;
}

} // namespace foam::inline sdk
