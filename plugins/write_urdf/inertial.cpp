#include "sphere_urdf.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/volumes.hpp>

#include <fmt/format.h>

#include <map>

namespace foam {
namespace {

/// The comment says what a reader of the file cannot see: that nobody has measured the mass.
std::string inertial_element(const MassProperties& mass, double density) {
    const auto& [xx, yy, zz, xy, xz, yz] = mass.inertia;
    return fmt::format("<inertial><!-- foam: collision geometry at {} kg/m3 --><origin xyz=\"{} {} {}\" rpy=\"0 0 "
                       "0\"/><mass value=\"{}\"/>"
                       "<inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/></inertial>",
                       number_text(density), number_text(mass.center.x), number_text(mass.center.y),
                       number_text(mass.center.z), number_text(mass.mass), number_text(xx), number_text(xy),
                       number_text(xz), number_text(yy), number_text(yz), number_text(zz));
}

/// Whether a joint between the link and the root moves.
bool link_moves(const Robot& robot, const std::map<std::string, const Joint*>& above, const std::string& link) {
    std::size_t steps = 0;
    for (auto it = above.find(link); it != above.end() && steps <= robot.joints.size(); ++steps) {
        if (it->second->kind != Joint::Kind::fixed) {
            return true;
        }
        it = above.find(it->second->parent);
    }
    return false;
}

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ", "));
}

} // namespace

void add_inertials(SphereUrdf& urdf, InertialOf which, double density, Context& context) {
    const Robot& robot = *urdf.model().robot;
    std::map<std::string, const Joint*> above;
    for (const Joint& joint : robot.joints) {
        above[joint.child] = &joint;
    }
    std::vector<std::string> given, open, without;
    for (const Link& link : robot.links) {
        if (urdf.link(link.name).child("inertial") ||
            (which == InertialOf::moving && !link_moves(robot, above, link.name))) {
            continue;
        }
        const auto geometry = urdf.model().geometry.find(link.name);
        const auto mass =
            geometry == urdf.model().geometry.end() ? std::nullopt : mass_properties(*geometry->second, density);
        if (!mass) {
            const auto joint = above.find(link.name);
            if (!link.collisions.empty() || (joint != above.end() && joint->second->kind != Joint::Kind::fixed)) {
                without.push_back(link.name); // any other is a frame: programs unite it with what it is fixed to
            }
            continue;
        }
        urdf.editor().append_child(urdf.link(link.name), inertial_element(*mass, density));
        (geometry->second->closed() ? given : open).push_back(link.name);
    }
    const std::string of = fmt::format("<inertial> of the collision geometry at {} kg/m³", number_text(density));
    if (!given.empty()) {
        context.log(Severity::info, fmt::format("{} is written for {}", of, joined(given)));
    }
    if (!open.empty()) {
        context.log(Severity::warning,
                    fmt::format("{} is written for {}, whose meshes are not closed: what lies inside is decided by the "
                                "winding number; remedy: close the meshes, or add <inertial> to the URDF",
                                of, joined(open)));
    }
    if (!without.empty()) {
        context.log(Severity::warning, fmt::format("no <inertial> is written for {}, which have no collision geometry "
                                                   "with a volume; remedy: add <inertial> to the URDF",
                                                   joined(without)));
    }
}

} // namespace foam
