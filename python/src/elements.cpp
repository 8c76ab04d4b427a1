#include "robot.hpp"

#include <foam/base/error.hpp>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::python {
namespace {

using Numbers3 = std::array<double, 3>;

Numbers3 numbers(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Vec3 vector(const Numbers3& n) {
    return {n[0], n[1], n[2]};
}

/// Returns the keys of a kind besides kind, position and rotation.
std::vector<std::string> keys_of(Element::Kind kind) {
    switch (kind) {
    case Element::Kind::sphere:
        return {"radius"};
    case Element::Kind::capsule:
    case Element::Kind::cylinder:
        return {"length", "radius"};
    case Element::Kind::box:
        return {"size"};
    case Element::Kind::swept_box:
        return {"size", "radius"};
    case Element::Kind::hull:
        return {"vertices"};
    }
    return {};
}

[[noreturn]] void fail(const std::string& what) {
    throw Error(ErrorCode::usage, "an element " + what);
}

template <class T> T value_of(const py::dict& values, const char* key) {
    try {
        return py::cast<T>(values[key]);
    } catch (const py::cast_error&) {
        fail(fmt::format("has no numbers of the right form for '{}'", key));
    }
}

void check_keys(const py::dict& values, Element::Kind kind) {
    std::vector<std::string> known = keys_of(kind);
    for (const std::string& key : known) {
        if (!values.contains(key)) {
            fail(fmt::format("of kind {} needs '{}'", to_string(kind), key));
        }
    }
    known.insert(known.end(), {"kind", "position", "rotation"});
    for (const auto& [key, value] : values) {
        const auto name = py::cast<std::string>(py::str(key));
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            fail(fmt::format("of kind {} has no '{}'; there are: {}", to_string(kind), name, fmt::join(known, ", ")));
        }
    }
}

} // namespace

py::dict dict_of(const Element& element) {
    py::dict values;
    values["kind"] = to_string(element.kind);
    values["position"] = numbers(element.pose.translation);
    std::array<Numbers3, 3> rotation;
    std::transform(element.pose.rotation.begin(), element.pose.rotation.end(), rotation.begin(),
                   [](const Vec3& row) { return numbers(row); });
    values["rotation"] = rotation;
    for (const std::string& key : keys_of(element.kind)) {
        if (key == "radius") {
            values["radius"] = element.radius;
        } else if (key == "length") {
            values["length"] = 2 * element.half.z;
        } else if (key == "size") {
            values["size"] = numbers(element.half * 2);
        } else {
            std::vector<Numbers3> vertices;
            for (const Vec3& vertex : element.hull->surface.vertices) {
                vertices.push_back(numbers(vertex));
            }
            values["vertices"] = vertices;
        }
    }
    return values;
}

Element element_of_dict(const py::dict& values) {
    const auto word = values.contains("kind") ? value_of<std::string>(values, "kind") : std::string();
    const std::optional<Element::Kind> kind = element_kind_named(word);
    if (!kind) {
        fail(fmt::format("has the kind '{}'; there are: sphere, capsule, cylinder, box, swept_box, hull", word));
    }
    check_keys(values, *kind);
    Element element;
    element.kind = *kind;
    if (values.contains("position")) {
        element.pose.translation = vector(value_of<Numbers3>(values, "position"));
    }
    if (values.contains("rotation")) {
        const auto rows = value_of<std::array<Numbers3, 3>>(values, "rotation");
        std::transform(rows.begin(), rows.end(), element.pose.rotation.begin(), vector);
    }
    if (values.contains("radius")) {
        element.radius = value_of<double>(values, "radius");
    }
    if (values.contains("length")) {
        element.half.z = value_of<double>(values, "length") / 2;
    }
    if (values.contains("size")) {
        element.half = vector(value_of<Numbers3>(values, "size")) * 0.5;
    }
    if (values.contains("vertices")) {
        std::vector<Vec3> vertices;
        for (const Numbers3& vertex : value_of<std::vector<Numbers3>>(values, "vertices")) {
            vertices.push_back(vector(vertex));
        }
        element.hull = convex_hull(vertices);
    }
    if (!is_valid(element)) {
        fail(fmt::format("of kind {} has numbers that are not finite, no volume, or a rotation that is none", word));
    }
    return element;
}

py::list elements_of(const SphereFile& file) {
    py::list links;
    for (const LinkSpheres& link : file.links) {
        py::list elements;
        for (const Element& element : link.elements.shaped()) {
            elements.append(dict_of(element));
        }
        if (!link.elements.are_spheres()) {
            links.append(py::make_tuple(link.link, elements));
        }
    }
    return links;
}

SphereFile file_of_model(const SphereModel& model) {
    SphereFile file;
    file.file = model.name;
    file.format = "foam";
    for (const SphereGroup& group : model.groups) {
        auto link = std::find_if(file.links.begin(), file.links.end(),
                                 [&](const LinkSpheres& known) { return known.link == group.link; });
        if (link == file.links.end()) {
            link = file.links.insert(link, {group.link, {}});
        }
        link->elements.add(group.tree.elements());
    }
    return file;
}

} // namespace foam::python
