#include "grasp_scene.hpp"

#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline bench::experiment {
namespace {

constexpr double density = 1000; ///< kg/m³, of the links

/// Position control of a joint.
struct Servo {
    double stiffness, damping; ///< N/m and N s/m; N m/rad and N m s/rad
    double limit;              ///< N; N m
};
constexpr Servo arm_servo{10000, 200, 500}, finger_servo{5000, 100, 20};

std::string numbers_of(const Vec3& v) {
    return fmt::format("{} {} {}", v.x, v.y, v.z);
}

/// The frame's x and y axes: MJCF's way to say a rotation by its matrix.
std::string numbers_of(const Pose& pose) {
    const auto& r = pose.rotation;
    return fmt::format("pos=\"{}\" xyaxes=\"{} {} {} {} {} {}\"", numbers_of(pose.translation), r[0].x, r[1].x, r[2].x,
                       r[0].y, r[1].y, r[2].y);
}

/// The inertia of a box of the bounds' size, with the mass of the solid.
std::string inertial_of(const GraspLink& link) {
    if (!link.solid) {
        return "<inertial pos=\"0 0 0\" mass=\"0.01\" diaginertia=\"1e-5 1e-5 1e-5\"/>";
    }
    const double mass = std::max(density * link.solid->volume(), 0.01);
    const Vec3 s = link.solid->bounds().size();
    const auto about = [&](double a, double b) { return std::max(mass / 12 * (a * a + b * b), 1e-6); };
    return fmt::format("<inertial pos=\"{}\" mass=\"{}\" diaginertia=\"{} {} {}\"/>",
                       numbers_of(link.solid->bounds().center()), mass, about(s.y, s.z), about(s.x, s.z),
                       about(s.x, s.y));
}

class Writer {
public:
    Writer(const Kinematics& kinematics, const std::vector<GraspLink>& links, const std::vector<std::size_t>& fingers)
        : kinematics_(kinematics), robot_(kinematics.robot()), links_(links), fingers_(fingers) {}

    std::string name(std::size_t link) const { return markup_escaped(robot_.links[link].name); }

    void body(std::size_t link) {
        const auto joint = kinematics_.joint_above()[link];
        bodies +=
            fmt::format("<body name=\"{}\" {}>", name(link), numbers_of(joint ? robot_.joints[*joint].origin : Pose{}));
        bodies += inertial_of(links_[link]);
        if (joint && kinematics_.motions()[*joint].freedom) {
            const bool finger = std::find(fingers_.begin(), fingers_.end(), link) != fingers_.end();
            add_joint(*joint, finger ? finger_servo : arm_servo);
        }
        geometry(links_[link]);
        bodies += '\n';
        for (std::size_t child = 0; child < robot_.links.size(); ++child) {
            const auto above = kinematics_.joint_above()[child];
            if (above && kinematics_.link_above()[*above] == link) {
                body(child);
            }
        }
        bodies += "</body>\n";
    }

    std::string bodies, assets, actuators;
    std::vector<std::size_t> joints;

private:
    void add_joint(std::size_t index, const Servo& servo) {
        const Joint& joint = robot_.joints[index];
        const std::string joint_name = markup_escaped(joint.name);
        bodies += fmt::format("<joint name=\"{}\" type=\"{}\" axis=\"{}\" damping=\"{}\" armature=\"0.1\"/>",
                              joint_name, joint.kind == Joint::Kind::prismatic ? "slide" : "hinge",
                              numbers_of(joint.axis), servo.damping);
        actuators += fmt::format("<position joint=\"{0}\" kp=\"{1}\" forcelimited=\"true\" forcerange=\"-{2} {2}\"/>\n",
                                 joint_name, servo.stiffness, servo.limit);
        joints.push_back(index);
    }

    void geometry(const GraspLink& link) {
        for (const Sphere& sphere : link.spheres) {
            bodies +=
                fmt::format("<geom type=\"sphere\" size=\"{}\" pos=\"{}\"/>", sphere.radius, numbers_of(sphere.center));
        }
        if (link.spheres.empty() && link.solid) {
            for (const Solid::Part& part : link.solid->parts()) {
                solid_part(part);
            }
        }
    }

    void solid_part(const Solid::Part& part) {
        if (part.primitive && part.primitive->kind == Element::Kind::sphere) {
            bodies +=
                fmt::format("<geom type=\"sphere\" size=\"{}\" {}/>", part.primitive->radius, numbers_of(part.pose));
        } else if (part.primitive && part.primitive->kind == Element::Kind::box) {
            bodies += fmt::format("<geom type=\"box\" size=\"{}\" {}/>", numbers_of(part.primitive->half),
                                  numbers_of(part.pose));
        } else if (part.primitive) {
            bodies += fmt::format("<geom type=\"{}\" size=\"{} {}\" {}/>", to_string(part.primitive->kind),
                                  part.primitive->radius, part.primitive->half.z, numbers_of(part.pose));
        } else {
            std::string vertices;
            for (const Vec3& v : part.mesh->vertices) {
                vertices += numbers_of(v) + ' ';
            }
            assets += fmt::format("<mesh name=\"m{}\" vertex=\"{}\"/>\n", meshes_, vertices);
            bodies += fmt::format("<geom type=\"mesh\" mesh=\"m{}\"/>", meshes_++);
        }
    }

    const Kinematics& kinematics_;
    const Robot& robot_;
    const std::vector<GraspLink>& links_;
    const std::vector<std::size_t>& fingers_;
    std::size_t meshes_ = 0;
};

Vec3 center_of(const GraspObject& object) {
    return object.position + Vec3{0, 0, object.size.z / 2};
}

std::string object_text(const GraspObject& object) {
    return fmt::format(
        "<body name=\"object\" pos=\"{}\"><freejoint/><geom type=\"box\" size=\"{}\" mass=\"{}\"/></body>\n",
        numbers_of(center_of(object)), numbers_of(object.size / 2), object.mass);
}

} // namespace

GraspScene grasp_scene(const Kinematics& kinematics, const std::vector<GraspLink>& links, const GraspSetup& setup) {
    Writer writer(kinematics, links, setup.fingers);
    for (std::size_t link = 0; link < links.size(); ++link) {
        if (!kinematics.joint_above()[link]) {
            writer.body(link);
        }
    }
    std::string exclusions;
    for (const auto& [a, b] : setup.excluded) {
        exclusions += fmt::format("<exclude body1=\"{}\" body2=\"{}\"/>\n", writer.name(a), writer.name(b));
    }
    for (const std::size_t link : setup.object_ignores) {
        exclusions += fmt::format("<exclude body1=\"{}\" body2=\"object\"/>\n", writer.name(link));
    }
    GraspScene scene;
    scene.joints = writer.joints;
    scene.object = center_of(setup.object);
    scene.text = fmt::format(
        "<mujoco>\n<compiler angle=\"radian\"/>\n"
        "<option timestep=\"{}\" cone=\"elliptic\" impratio=\"10\"/>\n"
        "<size nconmax=\"100\" njmax=\"300\"/>\n"
        "<default><geom condim=\"4\" friction=\"1 0.02 0.001\"/></default>\n"
        "<asset>\n{}</asset>\n<worldbody>\n<geom type=\"plane\" size=\"5 5 0.1\"/>\n{}{}</worldbody>\n"
        "<contact>\n{}</contact>\n<actuator>\n{}</actuator>\n</mujoco>\n",
        setup.timestep, writer.assets, writer.bodies, object_text(setup.object), exclusions, writer.actuators);
    return scene;
}

} // namespace foam::bench::experiment
