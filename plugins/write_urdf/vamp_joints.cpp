#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace foam {
namespace {

/// Makes a joint fixed at `value`; its origin keeps its bytes if it does not change.
void fix(SphereUrdf& urdf, const Joint& joint, double value) {
    const xml::Element& element = urdf.joint(joint.name);
    urdf.editor().set_attribute(element, "type", "fixed");
    const Pose pose = joint.origin * joint_motion(joint, value);
    if (pose != joint.origin) {
        std::string origin = fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", three_numbers(pose.translation),
                                         three_numbers(roll_pitch_yaw(pose)));
        if (const xml::Element* old = element.child("origin")) {
            urdf.editor().replace(old->span, std::move(origin));
        } else {
            urdf.editor().append_child(element, std::move(origin));
        }
    }
    for (const char* gone : {"limit", "mimic"}) {
        for (const xml::Element* child : element.children_named(gone)) {
            urdf.editor().remove(*child);
        }
    }
}

/// Gives a joint that turns without end, or without <limit>, the limits -π and π.
void limit_to_one_turn(SphereUrdf& urdf, const Joint& joint) {
    const xml::Element& element = urdf.joint(joint.name);
    const std::string pi = number_text(std::numbers::pi);
    urdf.editor().set_attribute(element, "type", "revolute");
    const xml::Element* limit = element.child("limit");
    if (!limit) { // a revolute joint needs effort and velocity; cricket does not use them
        urdf.editor().append_child(
            element, fmt::format("<limit lower=\"-{}\" upper=\"{}\" effort=\"0\" velocity=\"0\"/>", pi, pi));
        return;
    }
    urdf.editor().set_attribute(*limit, "lower", "-" + pi);
    urdf.editor().set_attribute(*limit, "upper", pi);
    for (const char* required : {"effort", "velocity"}) {
        if (!limit->attribute(required)) {
            urdf.editor().set_attribute(*limit, required, "0");
        }
    }
}

[[noreturn]] void refuse_mimic(const SphereUrdf& urdf, const std::string& joint, const std::string& followed) {
    throw Error(ErrorCode::output,
                fmt::format("{0}: joint '{1}' mimics '{2}', and cricket would plan each of them; remedy: hold them: "
                            "--lock {2}=VALUE, or robot: {{lock_joints: {{{2}: VALUE}}}} in the recipe",
                            urdf.writer(), joint, followed));
}

} // namespace

void fix_joints(SphereUrdf& urdf, Context& context) {
    const SphereModel& model = urdf.model();
    const Kinematics kinematics(model.robot);
    const PlannedJoints joints = planned_joints(model);
    if (joints.active.empty()) {
        throw Error(ErrorCode::output,
                    urdf.writer() + " needs a joint that moves and is not locked; the robot has none");
    }
    const JointValues locked(joints.locked.begin(), joints.locked.end());
    std::vector<std::string> fixed;
    for (std::size_t i = 0; i < model.robot->joints.size(); ++i) {
        const Joint& joint = model.robot->joints[i];
        const JointMotion& motion = kinematics.motions()[i];
        if (joint.kind == Joint::Kind::fixed) {
            continue;
        }
        if (!motion.freedom) { // planar, floating, or mimics one that does not move
            fix(urdf, joint, motion.offset);
            fixed.push_back(joint.name);
            continue;
        }
        const std::string& followed = kinematics.freedoms()[*motion.freedom].joint;
        if (const auto held = locked.find(followed); held != locked.end()) {
            fix(urdf, joint, motion.multiplier * held->second + motion.offset);
        } else if (followed != joint.name) {
            refuse_mimic(urdf, joint.name, followed);
        } else if (joint.kind == Joint::Kind::continuous ||
                   (joint.kind == Joint::Kind::revolute && !urdf.joint(joint.name).child("limit"))) {
            limit_to_one_turn(urdf, joint);
        }
    }
    if (!fixed.empty()) {
        context.log(Severity::info, fmt::format("planar and floating joints, and what mimics a fixed joint, are fixed "
                                                "where they stand: {}",
                                                fmt::join(fixed, ", ")));
    }
}

} // namespace foam
