// Pictures of robots and their spheres.
#include "robot.hpp"

#include <foam/runtime/shown_elements.hpp>
#include <foam/base/error.hpp>
#include <foam/geometry/figure.hpp>
#include <foam/sdk/stage.hpp>

#include <pybind11/stl.h>

namespace foam::python {
namespace {

/// A PNG: the geometry, translucent, over the spheres, in the root's frame. Joints are at zero, moved into their
/// limits.
py::bytes picture_of(const Registry& registry, const SphereFile& spheres, const HeldRobot* robot,
                     const std::string& title, int width, int height) {
    const std::string png = worked([&](const Signals&) {
        Panel panel;
        std::map<std::string, Pose> poses;
        if (robot) {
            poses = link_poses(*robot->original.robot);
            for (const OriginalLink& link : robot->original.links) {
                panel.meshes.push_back({std::make_shared<const Mesh>(link.solid->surface()), poses[link.link], true});
            }
        }
        for (const LinkSpheres& link : spheres.links) {
            const Pose& pose = poses[link.link];
            add_elements(panel, link.elements, pose);
        }
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

} // namespace

void add_picture(py::module_& module) {
    module.def("picture", &picture_of, py::arg("registry"), py::arg("spheres"), py::arg("robot").none(true),
               py::arg("title"), py::arg("width"), py::arg("height"));
}

} // namespace foam::python
