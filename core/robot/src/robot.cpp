#include <foam/base/error.hpp>
#include <foam/robot/kinematics.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline robot {
namespace {

double joint_value(const Joint& joint, const JointValues& values) {
    if (const auto it = values.find(joint.name); it != values.end()) {
        return it->second;
    }
    const bool limited = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::prismatic;
    return limited && joint.lower <= joint.upper ? std::clamp(0.0, joint.lower, joint.upper) : 0.0;
}

void require_known_joints(const Robot& robot, const JointValues& values) {
    for (const auto& [name, value] : values) {
        const auto is_named = [&, &name = name](const Joint& joint) { return joint.name == name; };
        if (std::none_of(robot.joints.begin(), robot.joints.end(), is_named)) {
            throw Error(
                ErrorCode::usage,
                fmt::format("a value is given for joint '{}', but robot '{}' has no such joint", name, robot.name));
        }
    }
}

} // namespace

std::vector<std::string> tips_of(const Robot& robot) {
    std::vector<std::string> tips;
    for (const Link& link : robot.links) {
        if (std::none_of(robot.joints.begin(), robot.joints.end(),
                         [&](const Joint& joint) { return joint.parent == link.name; })) {
            tips.push_back(link.name);
        }
    }
    return tips;
}

std::vector<std::filesystem::path> files_beside(const Robot& robot) {
    std::vector<std::filesystem::path> files = robot.further_files;
    for (const Link& link : robot.links) {
        for (const std::vector<GeometryElement>* elements : {&link.collisions, &link.visuals}) {
            for (const GeometryElement& element : *elements) {
                if (const auto* mesh = std::get_if<MeshReference>(&element.geometry); mesh && !mesh->path.empty()) {
                    files.push_back(mesh->path);
                }
            }
        }
    }
    return files;
}

const Link* Robot::find_link(const std::string& link) const {
    const auto it =
        std::find_if(links.begin(), links.end(), [&](const Link& candidate) { return candidate.name == link; });
    return it == links.end() ? nullptr : &*it;
}

std::map<std::string, Pose> link_poses(const Robot& robot, const JointValues& values) {
    require_known_joints(robot, values);
    std::multimap<std::string, const Joint*> joints_below;
    for (const Joint& joint : robot.joints) {
        joints_below.emplace(joint.parent, &joint);
    }
    std::map<std::string, Pose> poses{{robot.root, Pose{}}};
    std::vector<std::string> front{robot.root};
    while (!front.empty()) {
        const std::string parent = std::move(front.back());
        front.pop_back();
        const auto [begin, end] = joints_below.equal_range(parent);
        for (auto it = begin; it != end; ++it) {
            const Joint& joint = *it->second;
            const Pose pose = poses.at(parent) * joint.origin * joint_motion(joint, joint_value(joint, values));
            if (poses.emplace(joint.child, pose).second) {
                front.push_back(joint.child);
            }
        }
    }
    return poses;
}

} // namespace foam::robot
