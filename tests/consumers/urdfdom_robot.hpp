// A robot as urdfdom reads it: its spheres, and where they are by its joints.
#pragma once

#include "robots.hpp"

#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <cmath>

namespace foam::test {

inline Pose pose_of(const urdf::Pose& pose) {
    const urdf::Rotation& q = pose.rotation;
    const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    const double x = q.x / length, y = q.y / length, z = q.z / length, w = q.w / length;
    Pose result;
    result.rotation = {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                       Vec3{2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                       Vec3{2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    result.translation = {pose.position.x, pose.position.y, pose.position.z};
    return result;
}

inline Pose motion_of(const urdf::Joint& joint, double value) {
    const Vec3 axis{joint.axis.x, joint.axis.y, joint.axis.z};
    if (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS) {
        return Pose::from_axis_angle(axis / norm(axis), value);
    }
    Pose pose;
    if (joint.type == urdf::Joint::PRISMATIC) {
        pose.translation = axis * value;
    }
    return pose;
}

/// The pose of a link at joint positions, from the root.
inline Pose pose_of(const urdf::Link& link, const JointValues& values) {
    if (!link.parent_joint) {
        return {};
    }
    const urdf::Joint& joint = *link.parent_joint;
    const auto value = values.find(joint.name);
    return pose_of(*link.getParent(), values) * pose_of(joint.parent_to_joint_origin_transform) *
           motion_of(joint, value == values.end() ? 0 : value->second);
}

/// The collision spheres of a link in its own frame. Fails the test for other geometry.
inline std::vector<Sphere> spheres_of(const urdf::Link& link) {
    std::vector<Sphere> result;
    for (const urdf::CollisionSharedPtr& collision : link.collision_array) {
        const auto* sphere = dynamic_cast<const urdf::Sphere*>(collision->geometry.get());
        EXPECT_TRUE(sphere) << link.name;
        if (sphere) {
            const urdf::Vector3& p = collision->origin.position;
            result.push_back({{p.x, p.y, p.z}, sphere->radius});
        }
    }
    return result;
}

inline std::string urdf_of(const SphereModel& model) {
    QuietContext context;
    return writer("write_urdf", "write.urdf")->write(model, context);
}

} // namespace foam::test
