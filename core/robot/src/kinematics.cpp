#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/robot/kinematics.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

namespace foam::inline robot {
namespace {

bool moves(const Joint& joint) {
    return joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::continuous ||
           joint.kind == Joint::Kind::prismatic;
}

[[noreturn]] void fail(const Robot& robot, const Joint& joint, const std::string& what) {
    throw Error(ErrorCode::input, joint.line > 0
                                      ? fmt::format("{}:{}: {}", robot.file.string(), joint.line, shown(what))
                                      : shown(what));
}

Freedom freedom_of(const Joint& joint, const Robot& robot) {
    constexpr double pi = std::numbers::pi;
    if (joint.kind == Joint::Kind::prismatic && !joint.limited) {
        fail(robot, joint,
             fmt::format("prismatic joint '{}' has no limits; remedy: <limit lower=\"…\" upper=\"…\"/>", joint.name));
    }
    if (joint.kind == Joint::Kind::continuous || !joint.limited) {
        return {joint.name, -pi, pi};
    }
    if (joint.lower > joint.upper) {
        fail(robot, joint,
             fmt::format("the lower limit of joint '{}', {}, is above the upper one, {}", joint.name, joint.lower,
                         joint.upper));
    }
    return {joint.name, joint.lower, joint.upper};
}

/// Follows <mimic> from joint to joint until one that moves independently.
class MimicResolver {
public:
    MimicResolver(const Robot& robot, const std::vector<Freedom>& freedoms) : robot_(robot) {
        for (const Joint& joint : robot.joints) {
            joints_[joint.name] = &joint;
        }
        for (std::size_t i = 0; i < freedoms.size(); ++i) {
            freedom_index_[freedoms[i].joint] = i;
        }
    }

    JointMotion motion(const Joint& joint) const { return motion(joint, joint, 0); }

private:
    /// Returns the motion of a joint. `steps`: number of joints between the first one and this.
    JointMotion motion(const Joint& first, const Joint& joint, std::size_t steps) const {
        if (!moves(joint)) {
            return {};
        }
        if (const auto own = freedom_index_.find(joint.name); own != freedom_index_.end()) {
            return {own->second, 1, 0};
        }
        const Mimic& mimic = *joint.mimic;
        const auto other = joints_.find(mimic.joint);
        if (other == joints_.end()) {
            fail(
                robot_, joint,
                fmt::format("joint '{}' is to follow joint '{}', but there is no such joint", joint.name, mimic.joint));
        }
        if (steps == robot_.joints.size()) {
            fail(robot_, first,
                 fmt::format("joint '{}' follows itself: the <mimic> of its joints go round in a circle", first.name));
        }
        const JointMotion followed = motion(first, *other->second, steps + 1);
        return {followed.freedom, mimic.multiplier * followed.multiplier,
                mimic.multiplier * followed.offset + mimic.offset};
    }

    const Robot& robot_;
    std::map<std::string, const Joint*> joints_;
    std::map<std::string, std::size_t> freedom_index_;
};

} // namespace

Pose joint_motion(const Joint& joint, double value) {
    switch (joint.kind) {
    case Joint::Kind::revolute:
    case Joint::Kind::continuous:
        return Pose::from_axis_angle(joint.axis, value);
    case Joint::Kind::prismatic:
        return Pose{.translation = joint.axis * value};
    case Joint::Kind::fixed:
    case Joint::Kind::planar:
    case Joint::Kind::floating:
        break;
    }
    return {};
}

Kinematics::Kinematics(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {
    for (const Joint& joint : robot_->joints) {
        if (joint.mimic && !joint.mimic->problem.empty()) {
            throw Error(ErrorCode::input, joint.mimic->problem);
        }
    }
    for (const Joint& joint : robot_->joints) {
        if (moves(joint) && !joint.mimic) {
            freedoms_.push_back(freedom_of(joint, *robot_));
        }
    }
    const MimicResolver mimics(*robot_, freedoms_);
    for (const Joint& joint : robot_->joints) {
        motions_.push_back(mimics.motion(joint));
    }
    connect();
}

Kinematics::~Kinematics() = default;

void Kinematics::connect() {
    std::map<std::string, std::size_t> links;
    for (std::size_t i = 0; i < robot_->links.size(); ++i) {
        links[robot_->links[i].name] = i;
    }
    joint_above_.resize(robot_->links.size());
    std::vector<std::vector<std::size_t>> below(robot_->links.size());
    for (std::size_t i = 0; i < robot_->joints.size(); ++i) {
        link_above_.push_back(links.at(robot_->joints[i].parent));
        const std::size_t child = links.at(robot_->joints[i].child);
        joint_above_[child] = i;
        below[link_above_.back()].push_back(child);
    }
    order_.push_back(links.at(robot_->root));
    for (std::size_t i = 0; i < order_.size(); ++i) {
        for (const std::size_t next : below[order_[i]]) {
            order_.push_back(next);
        }
    }
}

std::vector<double> Kinematics::configuration(const JointValues& values) const {
    std::vector<double> result;
    std::size_t used = 0;
    for (const Freedom& freedom : freedoms_) {
        const auto value = values.find(freedom.joint);
        used += value == values.end() ? 0 : 1;
        result.push_back(value == values.end() ? std::clamp(0.0, freedom.lower, freedom.upper) : value->second);
    }
    if (used == values.size()) {
        return result;
    }
    for (const auto& [name, value] : values) {
        const auto joint = std::find_if(robot_->joints.begin(), robot_->joints.end(),
                                        [&, &name = name](const Joint& candidate) { return candidate.name == name; });
        if (joint == robot_->joints.end()) {
            throw Error(ErrorCode::usage, fmt::format("a value is given for joint '{}', but robot '{}' has no such "
                                                      "joint",
                                                      shown(name), shown(robot_->name)));
        }
        if (std::none_of(freedoms_.begin(), freedoms_.end(),
                         [&, &name = name](const Freedom& freedom) { return freedom.joint == name; })) {
            throw Error(ErrorCode::usage, fmt::format("a value is given for joint '{}', which {}", shown(name),
                                                      moves(*joint) ? "follows another" : "does not move"));
        }
    }
    return result;
}

std::vector<double> Kinematics::random_configuration(Random& random) const {
    std::vector<double> result;
    result.reserve(freedoms_.size());
    for (const Freedom& freedom : freedoms_) {
        result.push_back(random.uniform(freedom.lower, freedom.upper));
    }
    return result;
}

std::vector<double> Kinematics::joint_values(std::span<const double> configuration) const {
    std::vector<double> result;
    for (const JointMotion& motion : motions_) {
        result.push_back((motion.freedom ? motion.multiplier * configuration[*motion.freedom] : 0) + motion.offset);
    }
    return result;
}

std::vector<Pose> Kinematics::link_poses(std::span<const double> configuration) const {
    std::vector<Pose> poses(robot_->links.size());
    link_poses(configuration, poses);
    return poses;
}

void Kinematics::link_poses(std::span<const double> configuration, std::span<Pose> poses) const {
    for (const std::size_t link : order_) {
        if (!joint_above_[link]) {
            poses[link] = {};
            continue;
        }
        const std::size_t index = *joint_above_[link];
        const Joint& joint = robot_->joints[index];
        const JointMotion& motion = motions_[index];
        const Pose at_origin = poses[link_above_[index]] * joint.origin;
        if (!moves(joint)) {
            poses[link] = at_origin;
            continue;
        }
        const double value = (motion.freedom ? motion.multiplier * configuration[*motion.freedom] : 0) + motion.offset;
        poses[link] = at_origin * joint_motion(joint, value);
    }
}

} // namespace foam::robot
