#include "composed.hpp"

#include "sphere_urdf.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace foam {
namespace {

/// Returns ` name="value"`; nothing for a value that is empty.
std::string attribute_of(const char* name, const std::string& value) {
    return value.empty() ? "" : fmt::format(" {}=\"{}\"", name, attribute_escaped(value));
}

std::string attribute_of(const char* name, const std::optional<double>& value) {
    return value ? fmt::format(" {}=\"{}\"", name, number_text(*value)) : "";
}

/// Returns the <origin>; nothing for the identity, which is the default.
std::string origin_text(const Pose& pose) {
    return pose == Pose{} ? ""
                          : fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", three_numbers(pose.translation),
                                        three_numbers(short_roll_pitch_yaw(pose)));
}

std::string geometry_text(const Geometry& geometry) {
    if (const auto* primitive = std::get_if<Element>(&geometry)) {
        return shape_text(*primitive, {});
    }
    const auto& mesh = std::get<MeshReference>(geometry);
    return fmt::format("<mesh{}{}/>", attribute_of("filename", mesh.uri),
                       mesh.scale == Vec3{1, 1, 1} ? "" : attribute_of("scale", three_numbers(mesh.scale)));
}

std::string material_text(const Material& material) {
    std::string content;
    if (material.rgba) {
        const auto& [red, green, blue, opacity] = *material.rgba;
        content += fmt::format("<color rgba=\"{} {} {} {}\"/>", number_text(red), number_text(green), number_text(blue),
                               number_text(opacity));
    }
    content += material.texture.empty() ? "" : fmt::format("<texture{}/>", attribute_of("filename", material.texture));
    return fmt::format("<material name=\"{}\">{}</material>", attribute_escaped(material.name), content);
}

/// Collects the lines of the text.
class Lines {
public:
    void add(std::size_t depth, const std::string& content) {
        if (!content.empty()) {
            text += std::string(2 * depth, ' ') + content + "\n";
        }
    }
    std::string text = "<?xml version=\"1.0\"?>\n";
};

void add_element(Lines& lines, const char* tag, const GeometryElement& element) {
    lines.add(2, fmt::format("<{}{}>", tag, attribute_of("name", element.name)));
    lines.add(3, origin_text(element.origin));
    lines.add(3, "<geometry>" + geometry_text(element.geometry) + "</geometry>");
    lines.add(3, element.material ? material_text(*element.material) : "");
    lines.add(2, fmt::format("</{}>", tag));
}

/// Returns the element, or the parts of a capsule, which plain URDF has no word for; the first keeps the name.
std::vector<GeometryElement> in_words_of_urdf(const GeometryElement& element) {
    const auto* primitive = std::get_if<Element>(&element.geometry);
    if (!primitive || primitive->kind != Element::Kind::capsule) {
        return {element};
    }
    std::vector<GeometryElement> parts;
    for (Element part : capsule_parts(*primitive)) {
        GeometryElement& added = parts.emplace_back(element);
        added.origin = element.origin * std::exchange(part.pose, {});
        added.geometry = std::move(part);
        added.name = parts.size() == 1 ? element.name : "";
    }
    return parts;
}

/// Returns whether it is a mesh that a URDF cannot name.
bool stands_in_no_file(const GeometryElement& element) {
    const auto* mesh = std::get_if<MeshReference>(&element.geometry);
    return mesh && mesh->uri.empty();
}

void add_inertial(Lines& lines, const Inertial& inertial) {
    if (!inertial.mass || !inertial.moments) {
        return;
    }
    const auto& [xx, yy, zz, xy, xz, yz] = *inertial.moments;
    lines.add(2, "<inertial>");
    lines.add(3, origin_text(inertial.origin));
    lines.add(3, fmt::format("<mass{}/>", attribute_of("value", inertial.mass)));
    lines.add(3, fmt::format("<inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>",
                             number_text(xx), number_text(xy), number_text(xz), number_text(yy), number_text(yz),
                             number_text(zz)));
    lines.add(2, "</inertial>");
}

void add_link(Lines& lines, const Link& link) {
    const bool empty = !link.inertial && link.visuals.empty() && link.collisions.empty();
    lines.add(1, fmt::format("<link name=\"{}\"{}>", attribute_escaped(link.name), empty ? "/" : ""));
    if (link.inertial) {
        add_inertial(lines, *link.inertial);
    }
    for (const GeometryElement& visual : link.visuals) {
        for (const GeometryElement& part : in_words_of_urdf(visual)) {
            if (!stands_in_no_file(part)) {
                add_element(lines, "visual", part);
            }
        }
    }
    for (const GeometryElement& collision : link.collisions) {
        if (stands_in_no_file(collision)) {
            throw Error(ErrorCode::output, fmt::format("write.urdf: link '{}' keeps a mesh that no file has; remedy: "
                                                       "elements for it",
                                                       shown(link.name)));
        }
        for (const GeometryElement& part : in_words_of_urdf(collision)) {
            add_element(lines, "collision", part);
        }
    }
    lines.add(1, empty ? "" : "</link>");
}

/// Returns the <limit>; URDF wants effort and velocity wherever a joint has limits.
std::string limit_text(const Joint& joint) {
    const bool ranged = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::prismatic;
    if (ranged ? !joint.limited : !joint.effort && !joint.velocity) {
        return "";
    }
    const std::optional<double> lower = ranged ? std::optional(joint.lower) : std::nullopt,
                                upper = ranged ? std::optional(joint.upper) : std::nullopt;
    return fmt::format("<limit{}{}{}{}/>", attribute_of("lower", lower), attribute_of("upper", upper),
                       attribute_of("effort", joint.effort.value_or(0)),
                       attribute_of("velocity", joint.velocity.value_or(0)));
}

void add_joint(Lines& lines, const Joint& joint) {
    constexpr const char* kinds[] = {"fixed", "revolute", "continuous", "prismatic", "planar", "floating"};
    lines.add(1, fmt::format("<joint name=\"{}\" type=\"{}\">", attribute_escaped(joint.name),
                             kinds[static_cast<std::size_t>(joint.kind)]));
    lines.add(2, fmt::format("<parent link=\"{}\"/>", attribute_escaped(joint.parent)));
    lines.add(2, fmt::format("<child link=\"{}\"/>", attribute_escaped(joint.child)));
    lines.add(2, origin_text(joint.origin));
    if (joint.kind != Joint::Kind::fixed) {
        lines.add(2, fmt::format("<axis xyz=\"{}\"/>", three_numbers(joint.axis)));
        lines.add(2, limit_text(joint));
    }
    if (joint.damping || joint.friction) {
        lines.add(2, fmt::format("<dynamics{}{}/>", attribute_of("damping", joint.damping),
                                 attribute_of("friction", joint.friction)));
    }
    if (joint.mimic) {
        lines.add(2, fmt::format("<mimic{}{}{}/>", attribute_of("joint", joint.mimic->joint),
                                 attribute_of("multiplier", joint.mimic->multiplier),
                                 attribute_of("offset", joint.mimic->offset)));
    }
    lines.add(1, "</joint>");
}

} // namespace

std::string composed_urdf(const Robot& robot) {
    Lines lines;
    lines.add(0, fmt::format("<robot name=\"{}\">", attribute_escaped(robot.name)));
    for (const Link& link : robot.links) {
        add_link(lines, link);
    }
    for (const Joint& joint : robot.joints) {
        add_joint(lines, joint);
    }
    lines.add(0, "</robot>");
    return std::move(lines.text);
}

} // namespace foam
