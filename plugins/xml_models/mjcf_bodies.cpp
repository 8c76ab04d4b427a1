#include "mjcf_bodies.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::xml_models {
namespace {

std::string pose_text(const Pose& pose) {
    const bool moved = pose.translation != Vec3{}, turned = pose.rotation != Pose{}.rotation;
    return (moved ? attribute_text("pos", vector_text(pose.translation)) : "") +
           (turned ? attribute_text("quat", numbers_text(quaternion(pose))) : "");
}

} // namespace

MjcfBodies::MjcfBodies(const SphereModel& model, const KnownKinds& known, bool free, double density,
                       const MjcfVisuals& visuals, Context& context)
    : model_(model), visuals_(visuals), context_(context), kinematics_(model.robot), free_(free),
      inertias_(model, density) {
    for (LinkSpheres& link : in_known_kinds(elements_by_link(model), known)) {
        elements_[link.link] = std::move(link.elements);
    }
    keep_geometry();
    const PlannedJoints joints = planned_joints(model);
    for (const auto& [joint, position] : joints.locked) {
        locked_[joint] = position;
    }
}

std::string MjcfBodies::text() {
    const std::string base = base_link(model_);
    for (const Link& link : model_.robot->links) {
        if (link.name == world && (link.name != base || free_ || !elements_[world].empty())) {
            throw Error(ErrorCode::output, "write.mjcf: a link is called 'world', which is MuJoCo's own body; "
                                           "remedy: rename the link, unless it is a fixed base without spheres");
        }
    }
    if (base == world) {
        add_geoms(base, 2);
        add_children(base, 2);
    } else {
        add_body(base, {}, nullptr, 2);
    }
    inertias_.report(context_);
    return std::move(text_);
}

std::vector<DrivenJoint> MjcfBodies::driven() const {
    std::map<std::string, Pose> poses;
    const std::vector<Pose> at = kinematics_.link_poses(kinematics_.configuration(rest_pose()));
    for (std::size_t i = 0; i < at.size(); ++i) {
        poses[model_.robot->links[i].name] = at[i];
    }
    std::vector<DrivenJoint> result;
    for (const std::size_t index : joints_) {
        const Joint& joint = model_.robot->joints[index];
        const JointMotion& motion = kinematics_.motions()[index];
        if (motion.freedom && kinematics_.freedoms()[*motion.freedom].joint == joint.name) {
            result.push_back({&joint, moved_inertia(joint, poses)});
        }
    }
    return result;
}

JointValues MjcfBodies::rest_pose() const {
    JointValues values = model_.facts.default_pose;
    values.insert(locked_.begin(), locked_.end());
    return values;
}

/// Returns the inertia of all that hangs on a joint: kg m² about its axis, or kg along it.
double MjcfBodies::moved_inertia(const Joint& joint, const std::map<std::string, Pose>& poses) const {
    const Pose& at = poses.at(joint.child); // the axis turns nothing of itself
    const Vec3 axis = at.rotate(joint.axis);
    double inertia = 0;
    for (const std::string& link : links_below(*model_.robot, joint.child)) {
        const auto found = inertias_.written().find(link);
        if (found == inertias_.written().end()) {
            continue;
        }
        const MassProperties& mass = found->second;
        if (joint.kind == Joint::Kind::prismatic) {
            inertia += mass.mass;
            continue;
        }
        const Pose& pose = poses.at(link);
        const Vec3 arm = cross(axis, pose * mass.center - at.translation), own = pose.inverse().rotate(axis);
        const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
        inertia += mass.mass * dot(arm, arm) + xx * own.x * own.x + yy * own.y * own.y + zz * own.z * own.z +
                   2 * (xy * own.x * own.y + xz * own.x * own.z + yz * own.y * own.z);
    }
    return inertia;
}

std::string MjcfBodies::keyframe(bool targets) const {
    const std::vector<double> configuration = kinematics_.configuration(rest_pose());
    std::vector<double> positions, controls;
    if (free_) {
        positions = {0, 0, 0, 1, 0, 0, 0};
    }
    bool moved = false;
    for (const std::size_t joint : joints_) {
        const JointMotion& motion = kinematics_.motions()[joint];
        const double turned = motion.freedom ? motion.multiplier * configuration[*motion.freedom] : 0;
        positions.push_back(motion.offset + turned);
        moved = moved || positions.back() != 0;
        if (motion.freedom && kinematics_.freedoms()[*motion.freedom].joint == model_.robot->joints[joint].name) {
            controls.push_back(positions.back());
        }
    }
    const bool controlled = targets && !controls.empty();
    return moved ? "  <keyframe>\n    <key name=\"home\"" + attribute_text("qpos", numbers_text(positions)) +
                       (controlled ? attribute_text("ctrl", numbers_text(controls)) : "") + "/>\n  </keyframe>\n"
                 : "";
}

bool MjcfBodies::has_shaped() const {
    return std::any_of(elements_.begin(), elements_.end(),
                       [](const auto& link) { return !link.second.are_spheres(); });
}

/// Adds the primitives of links without elements, which keep their collision geometry.
void MjcfBodies::keep_geometry() {
    for (KeptGeometry& kept : kept_geometry(model_)) {
        if (!kept.primitives.empty()) {
            elements_[kept.link] = std::move(kept.primitives);
        }
        if (kept.meshes) {
            context_.log(Severity::warning,
                         fmt::format("link '{}' has no elements, and its collision meshes are not in the file: without "
                                     "contact in MuJoCo; remedy: elements for it",
                                     shown(kept.link)));
        }
    }
}

void MjcfBodies::add_body(const std::string& link, const Pose& pose, const Joint* joint, std::size_t depth) {
    line(depth, "<body" + attribute_text("name", link) + pose_text(pose) + ">");
    const bool moving = joint ? moves(*joint) : free_;
    if (!joint && free_) {
        line(depth + 1, "<freejoint/>");
    }
    const std::string inertial = inertias_.text(link, elements_[link], moving && !carries_mass(link));
    if (!inertial.empty()) {
        line(depth + 1, inertial);
    }
    if (joint && moving) {
        line(depth + 1, joint_text(*joint, context_));
        joints_.push_back(static_cast<std::size_t>(joint - model_.robot->joints.data()));
    }
    add_geoms(link, depth + 1);
    add_children(link, depth + 1);
    line(depth, "</body>");
}

void MjcfBodies::add_geoms(const std::string& link, std::size_t depth) {
    const std::vector<std::string> visuals = visuals_.of(link);
    for (const std::string& visual : visuals) {
        line(depth, "<geom class=\"visual\"" + visual + "/>");
    }
    // MuJoCo's windows show groups 0 to 2 at first: without visuals the elements are what there is to see.
    const std::string group = visuals.empty() ? attribute_text("group", "0") : "";
    for (const Sphere& s : elements_[link].spheres()) {
        line(depth, "<geom class=\"sphere\"" + group + attribute_text("pos", vector_text(s.center)) +
                        attribute_text("size", numbers_text({&s.radius, 1})) + "/>");
    }
    for (const Element& element : elements_[link].shaped()) {
        line(depth, "<geom class=\"element\"" + group + shapes_.attributes(element) + "/>");
    }
}

void MjcfBodies::add_children(const std::string& link, std::size_t depth) {
    for (const Joint& child : model_.robot->joints) {
        if (child.parent == link) {
            const auto held = locked_.find(child.name);
            add_body(child.child,
                     held == locked_.end() ? child.origin : child.origin * joint_motion(child, held->second), &child,
                     depth);
        }
    }
}

bool MjcfBodies::moves(const Joint& joint) const {
    return joint.kind != Joint::Kind::fixed && !locked_.contains(joint.name);
}

/// Returns whether a link that is fixed to this one has a mass, which MuJoCo counts for both.
bool MjcfBodies::carries_mass(const std::string& link) const {
    return std::any_of(
        model_.robot->joints.begin(), model_.robot->joints.end(), [&](const Joint& joint) {
            if (joint.parent != link || moves(joint)) {
                return false;
            }
            const std::optional<Inertial>& inertial = model_.robot->find_link(joint.child)->inertial;
            return (inertial && inertial->mass && *inertial->mass > 0) || carries_mass(joint.child);
        });
}

} // namespace foam::xml_models
