#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/geometry/element_forms.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/recipe/robot_choices.hpp>
#include <foam/robot/kinematics.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <fmt/format.h>

#include <algorithm>

namespace foam::python {
namespace {

constexpr const char* words_of_joints[] = {"fixed", "revolute", "continuous", "prismatic", "planar", "floating"};

/// `name`: what the content of the file goes by; empty: the file's own name.
std::shared_ptr<HeldRobot> loaded_robot(const std::filesystem::path& file, std::shared_ptr<Registry> registry,
                                        const std::optional<std::string>& unit, double scale,
                                        const std::string& geometry, const std::vector<std::string>& links,
                                        const std::vector<std::filesystem::path>& package_path,
                                        const std::filesystem::path& name) {
    const std::vector<std::string>& words = words_of_covered_geometry();
    const auto word = std::find(words.begin(), words.end(), geometry);
    if (word == words.end()) {
        throw Error(ErrorCode::usage,
                    fmt::format("unknown geometry '{}'; there are: {}", geometry, fmt::join(words, ", ")));
    }
    return worked([&](const Signals&) {
        auto held = std::make_shared<HeldRobot>();
        held->registry = std::move(registry);
        held->original = load_original(file, *held->registry,
                                       {.links = links,
                                        .unit = {.unit = unit, .scale = scale},
                                        .geometry = static_cast<CoveredGeometry>(word - words.begin()),
                                        .package_path = package_path,
                                        .name = name,
                                        .keep_meshes = true});
        if (!name.empty()) {
            held->original.file = name;
        }
        return held;
    });
}

py::list joints_of(const HeldRobot& held) {
    py::list joints;
    for (const Joint& joint : held.original.robot->joints) {
        const auto row = [](const Vec3& v) { return py::make_tuple(v.x, v.y, v.z); };
        const auto& rotation = joint.origin.rotation;
        joints.append(py::make_tuple(joint.name, words_of_joints[static_cast<std::size_t>(joint.kind)], joint.parent,
                                     joint.child, row(joint.origin.translation),
                                     py::make_tuple(row(rotation[0]), row(rotation[1]), row(rotation[2])),
                                     row(joint.axis), joint.lower, joint.upper));
    }
    return joints;
}

std::vector<std::string> names_of(const HeldRobot& held, bool with_geometry) {
    std::vector<std::string> names;
    if (with_geometry) {
        for (const OriginalLink& link : held.original.links) {
            names.push_back(link.link);
        }
    } else {
        for (const Link& link : held.original.robot->links) {
            names.push_back(link.name);
        }
    }
    return names;
}

const std::shared_ptr<const Solid>& solid_of_link(const HeldRobot& held, const std::string& name) {
    for (const OriginalLink& link : held.original.links) {
        if (link.link == name) {
            return link.solid;
        }
    }
    throw Error(ErrorCode::usage,
                fmt::format("{}: no link '{}' with {}; there are: {}", held.original.file.string(), name,
                            to_string(held.original.geometry), fmt::join(names_of(held, true), ", ")));
}

/// Returns the parts of a link: primitives as dict_of() has elements, meshes as {"kind": "mesh", "mesh": Mesh}; in the
/// frame of the link.
py::list parts_of_link(const HeldRobot& held, const std::string& name) {
    py::list parts;
    for (const Solid::Part& part : solid_of_link(held, name)->parts()) {
        if (part.primitive) {
            parts.append(dict_of(moved(*part.primitive, part.pose)));
        } else {
            py::dict mesh;
            mesh["kind"] = "mesh";
            mesh["mesh"] = std::make_shared<HeldMesh>(*part.mesh);
            parts.append(mesh);
        }
    }
    return parts;
}

/// Returns the value of every joint, rad or m, in the order of joints_of(). Joints that are not named are at zero,
/// moved into their limits; those that mimic one follow it. Throws Error(usage) for a name that is no joint's.
std::vector<double> values_of_joints(const HeldRobot& held, const JointValues& values) {
    const Kinematics kinematics(held.original.robot);
    return kinematics.joint_values(kinematics.configuration(values));
}

/// What globs say of a link: its name, whether it is worked on, and its weight, if it has one.
using ChosenLink = std::tuple<std::string, bool, std::optional<double>>;

std::vector<ChosenLink> chosen_links(const HeldRobot& held, const std::vector<std::string>& keep,
                                     const std::vector<std::string>& skip,
                                     const std::vector<std::pair<std::string, double>>& weights) {
    const Robot& robot = *held.original.robot;
    const RobotChoices choices{.keep = keep, .skip = skip, .weights = weights};
    require_choices(choices, robot, "");
    std::vector<ChosenLink> links;
    for (const Link& link : robot.links) {
        std::optional<double> weight;
        for (const auto& [glob, value] : weights) {
            require_weight(value, fmt::format("{}", value), "");
            weight = glob == link.name || glob_matches(glob, link.name) ? value : weight;
        }
        links.emplace_back(link.name, is_chosen(choices, link.name), weight);
    }
    return links;
}

using ElementsOfLinks = std::vector<std::pair<std::string, std::vector<py::dict>>>;

SphereFile file_of(const std::vector<std::pair<std::string, py::buffer>>& links, const std::string& name,
                   const ElementsOfLinks& elements) {
    SphereFile file;
    file.file = name;
    file.format = "foam";
    for (const auto& [link, rows] : links) {
        file.links.push_back({link, spheres_of(rows)});
    }
    for (const auto& [link, others] : elements) {
        auto found = std::find_if(file.links.begin(), file.links.end(),
                                  [&, &name_of_link = link](const LinkSpheres& l) { return l.link == name_of_link; });
        if (found == file.links.end()) {
            found = file.links.insert(found, {link, {}});
        }
        for (const py::dict& other : others) {
            found->elements.add(element_of_dict(other));
        }
    }
    return file;
}

py::list links_of(const SphereFile& file) {
    py::list links;
    for (const LinkSpheres& link : file.links) {
        links.append(py::make_tuple(link.link, rows_of(link.elements.spheres())));
    }
    return links;
}

} // namespace

void add_robot(py::module_& module) {
    py::class_<HeldRobot, std::shared_ptr<HeldRobot>>(module, "Robot")
        .def(py::init(&loaded_robot), py::arg("file"), py::arg("registry"), py::arg("unit"), py::arg("scale"),
             py::arg("geometry"), py::arg("links"), py::arg("package_path"), py::arg("name"))
        .def("name", [](const HeldRobot& held) { return held.original.robot->name; })
        .def("root", [](const HeldRobot& held) { return held.original.robot->root; })
        .def("notes", [](const HeldRobot& held) { return held.original.notes; })
        .def("links", &names_of, py::arg("with_geometry"))
        .def("joints", &joints_of)
        .def(
            "mesh",
            [](const HeldRobot& held, const std::string& link) {
                return std::make_shared<HeldMesh>(solid_of_link(held, link));
            },
            py::arg("link"))
        .def("parts", &parts_of_link, py::arg("link"))
        .def("chosen_links", &chosen_links, py::arg("keep"), py::arg("skip"), py::arg("weights"))
        .def("joint_values", &values_of_joints, py::arg("values"));
    py::class_<SphereFile, std::shared_ptr<SphereFile>>(module, "SphereFile")
        .def(py::init(&file_of), py::arg("links"), py::arg("name"), py::arg("elements") = ElementsOfLinks())
        .def("links", &links_of)
        .def("elements", &elements_of)
        .def("format", [](const SphereFile& file) { return file.format; })
        .def("notes", [](const SphereFile& file) { return file.notes; });
    module.def(
        "read_spheres",
        [](const std::filesystem::path& file, const Registry& registry, const std::string& reader,
           const Renames& renames) {
            return worked([&](const Signals&) {
                auto read = std::make_shared<SphereFile>(read_sphere_file(file, registry, reader));
                rename_links(*read, renames);
                return read;
            });
        },
        py::arg("file"), py::arg("registry"), py::arg("reader"), py::arg("rename"));
}

} // namespace foam::python
