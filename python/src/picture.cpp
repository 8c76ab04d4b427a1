// Pictures of robots and their spheres.
#include "plain_picture.hpp"
#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/runtime/shown_elements.hpp>
#include <foam/sdk/stage.hpp>

#include <pybind11/stl.h>

namespace foam::python {
namespace {

/// Returns the geometry, translucent, over the elements, in the root's frame. Joints are at zero, moved into their
/// limits.
Panel panel_of(const SphereFile& spheres, const HeldRobot* robot) {
    Panel panel;
    std::map<std::string, Pose> poses;
    if (robot) {
        poses = link_poses(*robot->original.robot);
        for (const OriginalLink& link : robot->original.links) {
            panel.meshes.push_back({std::make_shared<const Mesh>(link.solid->surface()), poses[link.link], true});
        }
    }
    for (const LinkSpheres& link : spheres.links) {
        add_elements(panel, link.elements, poses[link.link]);
    }
    return panel;
}

/// A PNG of it, by the painter of snapshots.
py::bytes picture_of(const Registry& registry, const SphereFile& spheres, const HeldRobot* robot,
                     const std::string& title, int width, int height) {
    const std::string png = worked([&](const Signals&) {
        Panel panel = panel_of(spheres, robot);
        Figure figure;
        figure.title = title;
        figure.width = width;
        figure.height = height;
        figure.panels = {std::move(panel)};
        QuietContext context;
        return registry.make<Renderer>("snapshot.osmesa")->render(figure, context).png;
    });
    return png;
}

/// Red, green and blue of each pixel of it, without the painter.
py::bytes plain_pixels(const SphereFile& spheres, const HeldRobot* robot, int width, int height) {
    const std::vector<std::uint8_t> pixels =
        worked([&](const Signals&) { return plain_picture(panel_of(spheres, robot), width, height); });
    return {reinterpret_cast<const char*>(pixels.data()), pixels.size()};
}

/// A caption, the robot, and spheres or nothing: the robot's geometry then.
using GivenPanel = std::tuple<std::string, const HeldRobot*, const SphereFile*>;

/// A PNG of panels side by side, in the root's frame. `pose`: joint values, rad or m; other joints are at zero, moved
/// into their limits.
py::bytes side_by_side(const Registry& registry, const std::vector<GivenPanel>& given, const JointValues& pose,
                       const std::string& title, int width, int height, const std::string& renderer,
                       const std::map<std::string, ParameterValue>& parameters) {
    const std::string png = worked([&](const Signals&) {
        Figure figure;
        figure.title = title;
        figure.width = width;
        figure.height = height;
        for (const auto& [caption, robot, spheres] : given) {
            Panel& panel = figure.panels.emplace_back();
            panel.caption = caption;
            std::map<std::string, Pose> poses = link_poses(*robot->original.robot, pose);
            for (const OriginalLink& link : robot->original.links) {
                if (!spheres) {
                    panel.meshes.push_back(
                        {std::make_shared<const Mesh>(link.solid->surface()), poses[link.link], false});
                }
            }
            for (const LinkSpheres& link : spheres ? spheres->links : std::vector<LinkSpheres>()) {
                add_elements(panel, link.elements, poses[link.link]);
            }
        }
        QuietContext context;
        return registry.make<Renderer>(renderer, parameters)->render(figure, context).png;
    });
    return png;
}

} // namespace

void add_picture(py::module_& module) {
    module.def("side_by_side", &side_by_side, py::arg("registry"), py::arg("panels"), py::arg("pose"), py::arg("title"),
               py::arg("width"), py::arg("height"), py::arg("renderer"), py::arg("parameters"));
    module.def("plain_pixels", &plain_pixels, py::arg("spheres"), py::arg("robot").none(true), py::arg("width"),
               py::arg("height"));
    module.def("picture", &picture_of, py::arg("registry"), py::arg("spheres"), py::arg("robot").none(true),
               py::arg("title"), py::arg("width"), py::arg("height"));
}

} // namespace foam::python
