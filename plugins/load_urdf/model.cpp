#include "reader.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::urdf {
namespace {

/// Elements by name, for messages on the first use of a name.
using Names = std::map<std::string, const xml::Element*>;

void require_new(Names& names, const std::string& name, const xml::Element& element, const Reader& reader) {
    const auto [it, added] = names.emplace(name, &element);
    if (!added) {
        reader.fail(
            element,
            fmt::format("a second {} '{}'; the first is in line {}; remedy: give it another name, or remove one",
                        element.name, name, it->second->line));
    }
}

void refuse_xacro(const xml::Element& element, const Reader& reader) {
    if (element.name.starts_with("xacro:")) {
        reader.fail(element, fmt::format("<{}>: this is a xacro file; run xacro first: xacro IN.xacro > OUT.urdf",
                                         element.name));
    }
    for (const auto& child : element.children) {
        refuse_xacro(*child, reader);
    }
}

void require_robot(const xml::Element& root, const Reader& reader) {
    if (root.name == "sdf") {
        reader.fail(root, "this is an SDF file, not a URDF; convert it first");
    }
    if (root.name == "mujoco") {
        reader.fail(root, "this is an MJCF; load.mjcf reads it, but no plugin has it");
    }
    if (root.name != "robot") {
        reader.fail(root, fmt::format("the root element of a URDF is <robot>, not <{}>", root.name));
    }
}

Joint::Kind read_joint_kind(const xml::Element& element, const Reader& reader) {
    using Kind = Joint::Kind;
    static constexpr std::array<std::pair<const char*, Kind>, 6> kinds{{{"fixed", Kind::fixed},
                                                                        {"revolute", Kind::revolute},
                                                                        {"continuous", Kind::continuous},
                                                                        {"prismatic", Kind::prismatic},
                                                                        {"planar", Kind::planar},
                                                                        {"floating", Kind::floating}}};
    const std::string& type = reader.required(element, "type");
    if (type == "spherical") { // of Bullet
        reader.warn(element, "a spherical joint is read as floating, at its origin");
        return Kind::floating;
    }
    for (const auto& [name, kind] : kinds) {
        if (type == name) {
            return kind;
        }
        if (lower_case(type) == name) {
            reader.warn(element,
                        fmt::format("<joint type=\"{}\"> is read as {}; remedy: type=\"{}\"", type, name, name));
            return kind;
        }
    }
    reader.fail(
        element,
        fmt::format("unknown joint type '{}'; known: fixed, revolute, continuous, prismatic, planar, floating", type));
}

/// Returns what to do about a name that no link has.
std::string remedy_for_link(const std::string& link, const Names& links) {
    std::vector<std::string> known;
    std::string near;
    for (const auto& [other, place] : links) {
        known.push_back(other);
        near = words(other) == words(link) ? other : near; // blanks around it
    }
    near = near.empty() ? nearest_word(link, known) : near;
    return near.empty() ? fmt::format("remedy: <link name=\"{}\"/>", link) : fmt::format("did you mean '{}'?", near);
}

std::string read_joint_end(const xml::Element& joint, const char* tag, const Names& links, const Reader& reader) {
    const xml::Element* end = reader.only_child(joint, tag);
    const std::string* name = joint.attribute("name");
    if (!end) {
        reader.fail(joint, fmt::format("joint '{}' has no <{}>", name ? *name : "", tag));
    }
    const std::string& link = reader.required(*end, "link");
    if (!links.contains(link)) {
        reader.fail(*end, fmt::format("joint '{}' names link '{}' as {}, but there is no such link; {}",
                                      name ? *name : "", link, tag, remedy_for_link(link, links)));
    }
    return link;
}

/// Returns whether the attribute is an infinite number, as printf writes it.
bool is_infinite(const xml::Element& element, std::string_view attribute) {
    const std::string* text = element.attribute(attribute);
    const std::string word = text ? lower_case(*text) : "";
    return word == "inf" || word == "-inf" || word == "+inf" || word == "infinity" || word == "-infinity";
}

/// Returns a limit, 0 if it is absent. A point too many, as in "-1.57.", is no error.
double read_limit(const xml::Element& limit, std::string_view attribute, const Reader& reader) {
    const std::string* text = limit.attribute(attribute);
    if (text && text->ends_with('.') && std::count(text->begin(), text->end(), '.') == 2) {
        const std::string number = text->substr(0, text->size() - 1);
        if (const auto value = parse_number(number)) {
            reader.warn(limit, fmt::format("<limit {0}=\"{1}\"> is read as {2}; remedy: {0}=\"{2}\"", attribute, *text,
                                           number));
            return *value;
        }
    }
    return reader.number(limit, attribute).value_or(0);
}

void read_motion(Joint& joint, const xml::Element& element, const Reader& reader) {
    if (const xml::Element* axis = reader.only_child(element, "axis"); axis && joint.kind != Joint::Kind::fixed) {
        const Vec3 direction = reader.vector(*axis, "xyz").value_or(joint.axis);
        if (direction == Vec3{} && joint.kind != Joint::Kind::floating) {
            reader.warn(
                *axis,
                fmt::format("the axis of joint '{}' is zero, so it does not move; remedy: type=\"fixed\"", joint.name));
            joint.kind = Joint::Kind::fixed;
            return;
        }
        joint.axis = normalized(direction);
    }
    const bool limited = joint.kind == Joint::Kind::revolute || joint.kind == Joint::Kind::prismatic;
    if (const xml::Element* limit = reader.only_child(element, "limit"); limit && limited) {
        if (is_infinite(*limit, "lower") || is_infinite(*limit, "upper")) {
            reader.warn(*limit, "<limit> is infinite, so the joint is read without limits");
            joint.limited = false;
            return;
        }
        joint.lower = read_limit(*limit, "lower", reader);
        joint.upper = read_limit(*limit, "upper", reader);
    }
}

Mimic read_mimic(const xml::Element& element, const Reader& reader) {
    Mimic mimic;
    try {
        const std::string* joint = element.attribute("joint");
        if (!joint) {
            reader.fail(element, "<mimic> does not say which joint it follows; remedy: <mimic joint=\"NAME\"/>");
        }
        mimic.joint = *joint;
        mimic.multiplier = reader.number(element, "multiplier").value_or(1);
        mimic.offset = reader.number(element, "offset").value_or(0);
    } catch (const Error& error) {
        mimic.problem = error.what();
    }
    return mimic;
}

/// Returns a number that no result depends on: nothing where it cannot be read.
std::optional<double> number_of(const xml::Element* element, const char* attribute) {
    const std::string* text = element ? element->attribute(attribute) : nullptr;
    const std::vector<std::string_view> pieces = text ? words(*text) : std::vector<std::string_view>{};
    return pieces.size() == 1 ? parse_number(pieces.front()) : std::nullopt;
}

/// Reads what only some users of the robot need, and refuse then.
void read_details(Joint& joint, const xml::Element& element, const Reader& reader) {
    const xml::Element* limit = element.child("limit");
    const xml::Element* dynamics = element.child("dynamics");
    joint.line = element.line;
    joint.limited = joint.limited && limit;
    joint.effort = number_of(limit, "effort");
    joint.velocity = number_of(limit, "velocity");
    joint.damping = number_of(dynamics, "damping");
    joint.friction = number_of(dynamics, "friction");
    for (const xml::Element* mimic : element.children_named("mimic")) {
        if (!joint.mimic || joint.mimic->problem.empty()) { // the last one counts, if all can be read
            joint.mimic = read_mimic(*mimic, reader);
        }
    }
}

Joint read_joint(const xml::Element& element, const Names& links, const Reader& reader) {
    Joint joint;
    joint.name = reader.required(element, "name");
    joint.kind = read_joint_kind(element, reader);
    joint.parent = read_joint_end(element, "parent", links, reader);
    joint.child = read_joint_end(element, "child", links, reader);
    joint.origin = reader.origin(element);
    read_motion(joint, element, reader);
    read_details(joint, element, reader);
    return joint;
}

/// Adds the link "world" if joints name it as their parent and the file has none.
void add_implicit_world(Robot& robot, Names& links, const xml::Element& root, const Reader& reader) {
    for (const xml::Element* joint : root.children_named("joint")) {
        const xml::Element* parent = joint->child("parent");
        const std::string* link = parent ? parent->attribute("link") : nullptr;
        if (link && *link == "world" && links.emplace("world", parent).second) {
            reader.warn(*parent, "there is no link 'world'; it is added; remedy: <link name=\"world\"/>");
            robot.links.push_back({.name = "world", .collisions = {}, .visuals = {}});
        }
    }
}

/// Returns the parent joint of every link that has one.
std::map<std::string, const Joint*> joints_above(const Robot& robot, const Names& joints, const Reader& reader) {
    std::map<std::string, const Joint*> result;
    for (const Joint& joint : robot.joints) {
        const auto [it, added] = result.emplace(joint.child, &joint);
        if (!added) {
            reader.fail(*joints.at(joint.name), fmt::format("link '{}' is the child of two joints, '{}' and '{}'; a "
                                                            "URDF has trees alone; remedy: remove one of them",
                                                            joint.child, it->second->name, joint.name));
        }
    }
    return result;
}

/// Returns a name that no joint has.
std::string new_joint_name(const Robot& robot, const std::string& wanted) {
    std::string name = wanted;
    const auto taken = [&](const Joint& joint) { return joint.name == name; };
    for (int i = 2; std::any_of(robot.joints.begin(), robot.joints.end(), taken); ++i) {
        name = fmt::format("{}_{}", wanted, i);
    }
    return name;
}

/// Fixes the other roots to the first one, or to the link "world", with equal frames, as MuJoCo places them.
void join_roots(Robot& robot, std::vector<std::string> roots, const Names& links, const Reader& reader) {
    const auto world = std::find(roots.begin(), roots.end(), "world");
    robot.root = world == roots.end() ? roots.front() : *world;
    std::erase(roots, robot.root);
    for (const std::string& root : roots) {
        robot.joints.push_back({.name = new_joint_name(robot, robot.root + "_to_" + root),
                                .kind = Joint::Kind::fixed,
                                .parent = robot.root,
                                .child = root,
                                .origin = {}});
    }
    const std::string others = roots.size() == 1 ? "" : fmt::format(" and {} more", roots.size() - 1);
    reader.warn(
        *links.at(roots.front()),
        fmt::format("no joint leads to link '{0}'{1}, nor to '{2}'; read as fixed to '{2}' with equal frames, as "
                    "MuJoCo places them; ROS refuses several roots; remedy: a fixed joint from '{2}' to '{0}'",
                    roots.front(), others, robot.root));
}

/// Finds the link that is not a joint's child. Links and joints must form trees.
void find_root(Robot& robot, const Names& links, const Names& joints, const Reader& reader) {
    const std::map<std::string, const Joint*> above = joints_above(robot, joints, reader);
    std::vector<std::string> roots;
    for (const Link& link : robot.links) {
        if (!above.contains(link.name)) {
            roots.push_back(link.name);
        }
    }
    std::map<std::string, std::string> joint_above; // by name: the robot gets joints
    for (const auto& [link, joint] : above) {
        joint_above[link] = joint->name;
    }
    if (roots.size() > 1) {
        join_roots(robot, roots, links, reader);
    } else {
        robot.root = roots.empty() ? "" : roots.front();
    }
    const std::map<std::string, Pose> reached = link_poses(robot);
    for (const Link& link : robot.links) {
        if (!reached.contains(link.name) || roots.empty()) {
            reader.fail(
                *joints.at(joint_above.at(link.name)),
                fmt::format("the joints go round in a circle through link '{}'; a URDF has trees alone; remedy: "
                            "remove one of them",
                            link.name));
        }
    }
}

} // namespace

Robot read_robot(const xml::Element& root, const std::string& name, const Reader& reader, Context& context) {
    require_robot(root, reader);
    refuse_xacro(root, reader);
    Robot robot;
    const std::string* given = root.attribute("name");
    robot.name = given && !given->empty() ? *given : name;
    const std::map<std::string, Material> materials = materials_by_name(root);
    Names links, joints;
    CancellationCounter asking(64);
    for (const xml::Element* element : root.children_named("link")) {
        asking.check();
        robot.links.push_back(read_link(*element, materials, reader, context));
        require_new(links, robot.links.back().name, *element, reader);
    }
    if (robot.links.empty()) {
        reader.fail(root, "the robot has no links; remedy: a <link>, or of a file of macros the file that uses them");
    }
    add_implicit_world(robot, links, root, reader);
    for (const xml::Element* element : root.children_named("joint")) {
        robot.joints.push_back(read_joint(*element, links, reader));
        require_new(joints, robot.joints.back().name, *element, reader);
    }
    find_root(robot, links, joints, reader);
    return robot;
}

} // namespace foam::urdf
