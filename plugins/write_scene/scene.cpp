#include "scene.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/sdk/elements.hpp>
#include <foam/sdk/writing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::scene {
namespace {

bool is_control(char c) {
    return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

/// Throws for a name that MoveIt, which takes the rest of the line without blanks around it, reads as another.
void require_name(const std::string& link) {
    if (link.empty() || link.front() == ' ' || link.back() == ' ' ||
        std::any_of(link.begin(), link.end(), is_control)) {
        throw Error(
            ErrorCode::output,
            fmt::format("link '{}': a .scene holds no name that is empty, begins or ends with a blank, or has a "
                        "line end or control character; remedy: rename the link, or write.markers",
                        shown(link)));
    }
}

std::string first_line(std::string name) {
    std::replace_if(name.begin(), name.end(), is_control, ' ');
    return name + '\n';
}

std::string point_text(const Vec3& p) {
    return number_text(p.x) + ' ' + number_text(p.y) + ' ' + number_text(p.z) + '\n';
}

constexpr const char* no_colour = "0 0 0 0\n";

/// Returns a shape of MoveIt: what it is, its place and its colour.
std::string shape_text(const Element& element) {
    if (element.kind == Element::Kind::hull) {
        const Mesh& mesh = element.hull->surface;
        std::string text = fmt::format("mesh\n{} {}\n", mesh.vertices.size(), mesh.triangles.size());
        for (const Vec3& p : mesh.vertices) {
            text += point_text(p);
        }
        for (const auto& [a, b, c] : mesh.triangles) {
            text += fmt::format("{} {} {}\n", a, b, c);
        }
        return text + point_text(element.pose.translation) + "0 0 0 1\n" + no_colour;
    }
    const auto [x, y, z, w] = message_quaternion(element.pose);
    const Element stated = stated_at(element, from_quaternion(element.pose.translation, {w, x, y, z}));
    return (stated.kind == Element::Kind::box
                ? "box\n" + point_text(stated.half * 2)
                : "cylinder\n" + number_text(stated.radius) + ' ' + number_text(2 * stated.half.z) + '\n') +
           point_text(stated.pose.translation) +
           fmt::format("{} {} {} {}\n", number_text(x), number_text(y), number_text(z), number_text(w)) + no_colour;
}

std::string pose_text(const Pose& pose) {
    const auto [x, y, z, w] = message_quaternion(pose);
    return point_text(pose.translation) + number_text(x) + ' ' + number_text(y) + ' ' + number_text(z) + ' ' +
           number_text(w) + '\n';
}

} // namespace

std::string scene_text(const SphereModel& model, bool old_format) {
    const std::map<std::string, Pose> poses = placed_links(model);
    std::string text = first_line(model.name);
    for (const LinkSpheres& link : in_known_kinds(elements_by_link(model), {.capsules = false})) {
        require_name(link.link);
        const auto found = poses.find(link.link);
        const Pose pose = found == poses.end() ? Pose{} : found->second;
        if (old_format && pose != Pose{}) {
            throw Error(
                ErrorCode::output,
                fmt::format("link '{}' is not at the origin, and objects of the old .scene format have no pose; "
                            "remedy: version: new",
                            shown(link.link)));
        }
        text +=
            "* " + link.link + '\n' + (old_format ? "" : pose_text(pose)) + std::to_string(link.elements.size()) + '\n';
        CancellationCounter asking(1024);
        for (const Sphere& s : link.elements.spheres()) {
            asking.check();
            text += "sphere\n" + number_text(s.radius) + '\n' + point_text(s.center) + "0 0 0 1\n0 0 0 0\n";
        }
        for (const Element& element : link.elements.shaped()) {
            asking.check();
            text += shape_text(element);
        }
        text += old_format ? "" : "0\n"; // subframes
    }
    return text + ".\n"; // MoveIt refuses the file without the last line end
}

std::array<double, 4> message_quaternion(const Pose& pose) {
    const auto& [a, b, c] = pose.rotation;
    // The largest of the four components is computed by a root, the others from it: no digits cancel (Shepperd 1978).
    const std::array<double, 4> squares{1 + a.x - b.y - c.z, 1 - a.x + b.y - c.z, 1 - a.x - b.y + c.z,
                                        1 + a.x + b.y + c.z};
    const auto largest = static_cast<std::size_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
    const std::array<std::array<double, 4>, 4> products{{{squares[0], a.y + b.x, c.x + a.z, c.y - b.z},
                                                         {a.y + b.x, squares[1], b.z + c.y, a.z - c.x},
                                                         {c.x + a.z, b.z + c.y, squares[2], b.x - a.y},
                                                         {c.y - b.z, a.z - c.x, b.x - a.y, squares[3]}}};
    std::array<double, 4> q = products[largest];
    double length = 0;
    for (const double x : q) {
        length += x * x;
    }
    length = std::sqrt(length) * (q[3] < 0 ? -1 : 1);
    for (double& x : q) {
        x = x / length + 0.0; // never -0
    }
    return q;
}

} // namespace foam::scene
