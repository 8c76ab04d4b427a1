#include "input/inputs.hpp"

#include <foam/base/text.hpp>
#include <foam/geometry/length.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline runtime {
namespace {

/// The usual range of sizes of objects and robot parts, m.
constexpr double smallest = 0.001, largest = 20;

double longest_edge(const Box& box) {
    const Vec3 size = box.size();
    return std::max({size.x, size.y, size.z});
}

void add(InputSize& size, const CollisionElement& element, const Pose& link) {
    const Pose pose = link * element.source->origin;
    if (const Element* primitive = element.primitive()) {
        size.box.add(bounds(moved(*primitive, pose)));
    } else if (element.raw) {
        size.triangles += element.raw->triangles.size();
        for (const Vec3& vertex : element.raw->vertices) {
            size.box.add(pose * vertex);
        }
    }
}

std::string text_of(const Input& input, const InputSize& size, bool robot) {
    std::string text = input.file.filename().string() + ": ";
    if (robot) {
        text += fmt::format("{}, {} in the reference pose", counted(size.links, "link"), size_text(size.box));
    } else {
        text += size_text(size.box);
    }
    return size.triangles == 0 ? text : text + fmt::format(", {} triangle{}", count_text(size.triangles), size.triangles == 1 ? "" : "s");
}

/// Returns the unit in which a mesh would have a usual size; empty if there is none.
std::string likely_unit(const MeshUnit& given, double edge) {
    const double raw = edge / given.factor();
    for (const std::string& unit : length_units()) {
        const double would_be = raw * MeshUnit{unit, given.scale}.factor();
        if (unit != given.unit.value_or("m") && would_be >= smallest && would_be <= largest) {
            return unit;
        }
    }
    return "";
}

std::string unit_name(const std::string& unit) {
    return unit == "mm" ? "millimetres" : unit == "cm" ? "centimetres" : unit == "in" ? "inches" : "metres";
}

void warn_of_mesh_size(const Workspace& workspace, const Input& input, const InputSize& size) {
    const double edge = longest_edge(size.box);
    if (size.box.empty() || (edge >= smallest && edge <= largest)) {
        return;
    }
    const MeshUnit& given = workspace.recipe.mesh_unit;
    const MeshUnit metres{std::string("m"), 1};
    const bool own_unit = !why_refused(metres, input.file, InputKind::mesh, workspace.registry).empty();
    const std::string unit = own_unit ? "" : likely_unit(given, edge);
    const std::string remedy =
        unit.empty() ? fmt::format("if that is wrong: --scale {0}, or 'scale: {0}' in the recipe",
                                   number_text(given.scale * (edge > largest ? 0.001 : 1000)))
                     : fmt::format("if it is in {0}: --unit {1}, or 'unit: {1}' in the recipe", unit_name(unit), unit);
    workspace.journal.finding({Severity::warning, "", "",
                               fmt::format("{}: {} is {} for an object; {}", input.file.filename().string(),
                                           size_text(size.box), edge > largest ? "large" : "small", remedy)});
}

/// Returns the link with the longest edge, of those whose meshes are not scaled, and that edge.
std::pair<const LinkWork*, double> largest_unscaled(const std::vector<LinkWork>& links) {
    std::pair<const LinkWork*, double> found{nullptr, 0};
    for (const LinkWork& link : links) {
        for (const CollisionElement& element : link.elements) {
            const auto* mesh = std::get_if<MeshReference>(&element.source->geometry);
            if (!element.raw || !mesh || mesh->scale != Vec3{1, 1, 1}) {
                continue;
            }
            Box box;
            for (const Vec3& vertex : element.raw->vertices) {
                box.add(vertex);
            }
            if (!box.empty() && longest_edge(box) > found.second) {
                found = {&link, longest_edge(box)};
            }
        }
    }
    return found;
}

void warn_of_robot_size(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                        const InputSize& size) {
    const double edge = longest_edge(size.box);
    if (size.box.empty() || (edge >= smallest && edge <= largest)) {
        return;
    }
    const auto [link, length] = largest_unscaled(links);
    const std::string unit = link ? likely_unit({}, length) : "";
    const std::string factor = unit.empty() ? "" : number_text(MeshUnit{unit, 1}.factor());
    workspace.journal.finding(
        {Severity::warning, "", "",
         fmt::format("{}: {} is {} for a robot; {}", input.file.filename().string(), size_text(size.box),
                     edge > largest ? "large" : "small",
                     unit.empty() ? "a URDF is in metres"
                                  : fmt::format("if the mesh of link '{}' is in {}: <mesh scale=\"{} {} {}\"/>",
                                                link->link->name, unit_name(unit), factor, factor, factor))});
}

/// Questions lengths without a unit that are larger than the whole input.
void warn_of_lengths(const Workspace& workspace, const InputSize& size) {
    for (const PlainLength& length : workspace.recipe.plain_lengths) {
        const std::string question =
            size.box.empty() ? "" : question_about(length, longest_edge(size.box), "the whole input");
        if (!question.empty()) {
            workspace.journal.finding({Severity::warning, "", "", question});
        }
    }
}

} // namespace

InputSize input_size(const Robot& robot, const std::vector<LinkWork>& links) {
    const std::map<std::string, Pose> poses = link_poses(robot);
    InputSize size;
    for (const LinkWork& link : links) {
        const auto pose = poses.find(link.link->name);
        for (const CollisionElement& element : link.elements) {
            add(size, element, pose == poses.end() ? Pose{} : pose->second);
        }
    }
    size.links = links.size();
    return size;
}

void tell_input_size(const Workspace& workspace, const Input& input, const std::vector<LinkWork>& links,
                     const InputSize& size) {
    const bool robot = !workspace.recipe.urdf.empty();
    workspace.journal.emit(Event::Kind::input_loaded, text_of(input, size, robot));
    robot ? warn_of_robot_size(workspace, input, links, size) : warn_of_mesh_size(workspace, input, size);
    warn_of_lengths(workspace, size);
}

} // namespace foam::runtime
