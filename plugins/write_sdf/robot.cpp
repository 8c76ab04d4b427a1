// What SDF says of links and joints: http://sdformat.org/spec?ver=1.9, and Gazebo's import of URDF for the rest.
#include "robot.hpp"

#include "collisions.hpp"
#include "object.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace foam::sdf {
namespace {

class RobotText {
public:
    RobotText(const SphereModel& model, const KnownKinds& known, Context& context)
        : model_(model), robot_(*model.robot), context_(context), hulls_(file_name_of(model)) {
        for (LinkSpheres& link : in_known_kinds(elements_by_link(model), known)) {
            links_[link.link] = std::move(link);
        }
        for (KeptGeometry& kept : kept_geometry(model)) {
            if (kept.meshes) {
                without_contact_.push_back(kept.link);
            }
            if (!kept.primitives.empty()) {
                links_[kept.link] = {kept.link, std::move(kept.primitives)};
            }
        }
        for (const Joint& joint : robot_.joints) {
            above_[joint.child] = &joint;
        }
    }

    std::string run() {
        const std::string name = robot_.name.empty() ? model_.name : robot_.name;
        require_name(name, "model");
        std::string text = "<?xml version=\"1.0\"?>\n" + provenance_comment(model_.provenance) +
                           fmt::format("<sdf version=\"1.9\">\n  <model name=\"{}\">\n", markup_escaped(name));
        for (const Link& link : robot_.links) {
            if (!is_world(link.name)) {
                text += link_text(link);
            }
        }
        for (const Joint& joint : robot_.joints) {
            text += joint_text(joint);
        }
        report();
        return text + "  </model>\n</sdf>\n";
    }

private:
    /// Returns whether a link stands for the world, a name that SDF keeps.
    bool is_world(const std::string& link) const { return link == "world" && link == robot_.root; }

    /// Returns the joint's name, or one like it where a link has the same: SDF has one room for both.
    std::string name_of(const Joint& joint) const {
        std::string name = joint.name;
        while (robot_.find_link(name)) {
            name += "_joint";
        }
        return name;
    }

    std::string link_text(const Link& link) {
        require_name(link.name, "link");
        std::string text = fmt::format("    <link name=\"{}\">\n", markup_escaped(link.name));
        const auto joint = above_.find(link.name);
        if (joint != above_.end()) {
            text += "      " + place_of(*joint->second) + "\n";
        }
        text += inertial_text(link);
        for (std::size_t i = 0; i < link.visuals.size(); ++i) {
            text += visual_text(link, i);
        }
        if (const auto found = links_.find(link.name); found != links_.end()) {
            for (const CollisionText& collision : collisions_of(found->second, hulls_)) {
                text += fmt::format("      <collision name=\"{}\">\n        {}\n        {}\n      </collision>\n",
                                    collision.name, collision.pose, collision.geometry);
            }
        }
        return text + "    </link>\n";
    }

    /// Returns the <pose> of the link that a joint leads to.
    std::string place_of(const Joint& joint) const {
        if (is_world(joint.parent)) {
            return pose_text(joint.origin);
        }
        return is_free(joint) ? pose_text(joint.origin, joint.parent) : pose_text({}, name_of(joint));
    }

    std::string inertial_text(const Link& link) {
        const std::optional<Inertial>& inertial = link.inertial;
        if (inertial && !inertial->problem.empty()) {
            throw Error(ErrorCode::output, inertial->problem);
        }
        if (!inertial || inertial->mass.value_or(0) <= 0 || !inertial->moments) {
            if (!link.collisions.empty() || !link.visuals.empty()) {
                without_mass_.push_back(link.name);
            }
            return "";
        }
        const auto& m = *inertial->moments;
        return fmt::format("      <inertial>\n        {}\n        <mass>{}</mass>\n        <inertia><ixx>{}</ixx>"
                           "<iyy>{}</iyy><izz>{}</izz><ixy>{}</ixy><ixz>{}</ixz><iyz>{}</iyz></inertia>\n"
                           "      </inertial>\n",
                           pose_text(inertial->origin), number_text(*inertial->mass), number_text(m[0]),
                           number_text(m[1]), number_text(m[2]), number_text(m[3]), number_text(m[4]),
                           number_text(m[5]));
    }

    std::string visual_text(const Link& link, std::size_t index) {
        const GeometryElement& visual = link.visuals[index];
        std::string shape;
        Pose pose = visual.origin;
        if (const auto* element = std::get_if<Element>(&visual.geometry)) {
            if (element->kind == Element::Kind::hull || element->kind == Element::Kind::swept_box) {
                unseen_.insert(link.name);
                return "";
            }
            shape = shape_text(*element);
            pose = pose * element->pose;
        } else {
            const MeshReference& mesh = std::get<MeshReference>(visual.geometry);
            if (mesh.mesh || mesh.path.empty()) {
                unseen_.insert(link.name);
                return "";
            }
            const bool scaled = mesh.scale != Vec3{1, 1, 1};
            shape = fmt::format("<mesh><uri>{}</uri>{}</mesh>", markup_escaped(path_seen_from(model_.folder, mesh.path)),
                                scaled ? "<scale>" + vector_text(mesh.scale) + "</scale>" : "");
        }
        return fmt::format("      <visual name=\"visual_{}\">\n        {}\n        <geometry>{}</geometry>\n{}"
                           "      </visual>\n",
                           index, pose_text(pose), shape, material_text(visual));
    }

    static std::string material_text(const GeometryElement& visual) {
        if (!visual.material || !visual.material->rgba) {
            return "";
        }
        std::string colour;
        for (const double share : *visual.material->rgba) {
            colour += (colour.empty() ? "" : " ") + number_text(std::clamp(share, 0.0, 1.0));
        }
        return fmt::format("        <material><ambient>{0}</ambient><diffuse>{0}</diffuse></material>\n", colour);
    }

    static bool is_free(const Joint& joint) { return joint.kind == Joint::Kind::floating; }

    std::string joint_text(const Joint& joint) {
        if (joint.kind == Joint::Kind::planar) {
            throw Error(ErrorCode::output, fmt::format("write.sdf: joint '{}' is planar, which SDF has not; remedy: "
                                                       "write.urdf",
                                                       shown(joint.name)));
        }
        if (is_free(joint)) {
            return ""; // what no joint holds moves freely
        }
        const bool from_world = is_world(joint.parent);
        const std::string name = name_of(joint);
        require_name(name, "joint");
        const bool turns = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::continuous;
        const char* type = joint.kind == Joint::Kind::fixed ? "fixed" : turns ? "revolute" : "prismatic";
        std::string text = fmt::format("    <joint name=\"{}\" type=\"{}\">\n", markup_escaped(name), type);
        text += from_world ? "" : "      " + pose_text(joint.origin, joint.parent) + "\n";
        text += fmt::format("      <parent>{}</parent>\n      <child>{}</child>\n", markup_escaped(joint.parent),
                            markup_escaped(joint.child));
        text += joint.kind == Joint::Kind::fixed ? "" : axis_text(joint);
        if (joint.mimic) {
            following_.push_back(joint.name);
        }
        return text + "    </joint>\n";
    }

    static std::string axis_text(const Joint& joint) {
        std::string limit;
        if (joint.kind != Joint::Kind::continuous && joint.limited) {
            limit += fmt::format("<lower>{}</lower><upper>{}</upper>", number_text(joint.lower),
                                 number_text(joint.upper));
        }
        const auto add = [](std::string& text, const char* name, const std::optional<double>& value) {
            text += value && *value > 0 ? fmt::format("<{0}>{1}</{0}>", name, number_text(*value)) : "";
        };
        add(limit, "effort", joint.effort);
        add(limit, "velocity", joint.velocity);
        std::string losses;
        add(losses, "damping", joint.damping);
        add(losses, "friction", joint.friction);
        return fmt::format("      <axis>\n        <xyz>{}</xyz>\n{}{}      </axis>\n", vector_text(joint.axis),
                           limit.empty() ? "" : "        <limit>" + limit + "</limit>\n",
                           losses.empty() ? "" : "        <dynamics>" + losses + "</dynamics>\n");
    }

    void report() const {
        const auto warn = [&](const std::vector<std::string>& names, const char* what) {
            if (!names.empty()) {
                context_.log(Severity::warning, fmt::format("{}: {}", what, shown(first_names(names))));
            }
        };
        warn(without_mass_, "no <inertial> with a mass, and Gazebo takes 1 kg for each; remedy: add <inertial> to the "
                            "robot: links");
        warn(following_, "SDF 1.9 has no joints that follow others; these move by themselves");
        warn(without_contact_, "collision meshes of links without elements are not in the file; remedy: elements for them: links");
        warn({unseen_.begin(), unseen_.end()}, "visual meshes that are in no file of their own are left out: links");
    }

    const SphereModel& model_;
    const Robot& robot_;
    Context& context_;
    HullNames hulls_;
    std::map<std::string, LinkSpheres> links_;
    std::map<std::string, const Joint*> above_; ///< by the link that they lead to
    std::vector<std::string> without_mass_, following_, without_contact_;
    std::set<std::string> unseen_;
};

} // namespace

std::string robot_text(const SphereModel& model, const KnownKinds& known, Context& context) {
    return RobotText(model, known, context).run();
}

} // namespace foam::sdf
