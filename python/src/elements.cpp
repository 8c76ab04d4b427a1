#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/elements.hpp>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace foam::python {
namespace {

using Numbers3 = std::array<double, 3>;

template <class T> T value_of(const py::handle& value, const std::string& key) {
    try {
        return py::cast<T>(value);
    } catch (const py::cast_error&) {
        throw Error(ErrorCode::usage, fmt::format("an element has no numbers of the right form for '{}'", key));
    }
}

/// Returns the numbers of one name: lists of three for points and the rows of a rotation, a number for a length.
py::object shaped(const std::string& name, const std::vector<double>& numbers) {
    if (numbers.size() == 1) {
        return py::float_(numbers.front());
    }
    std::vector<Numbers3> rows;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        rows.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
    }
    if (name == "rotation") {
        return py::cast(std::array<Numbers3, 3>{rows.at(0), rows.at(1), rows.at(2)});
    }
    return name == "vertices" ? py::cast(rows) : py::cast(rows.at(0));
}

std::vector<double> flat(const std::string& name, const py::handle& value) {
    if (name == "length" || name == "radius") {
        return {value_of<double>(value, name)};
    }
    std::vector<double> numbers;
    if (name == "rotation" || name == "vertices") {
        for (const Numbers3& row : value_of<std::vector<Numbers3>>(value, name)) {
            numbers.insert(numbers.end(), row.begin(), row.end());
        }
        return numbers;
    }
    const auto row = value_of<Numbers3>(value, name);
    return {row.begin(), row.end()};
}

} // namespace

py::dict dict_of(const Element& element) {
    py::dict values;
    values["kind"] = to_string(element.kind);
    values["rotation"] = shaped("rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1});
    for (const auto& [name, numbers] : numbers_of(element)) {
        values[name.c_str()] = shaped(name, numbers);
    }
    return values;
}

Element element_of_dict(const py::dict& values) {
    const std::string word = values.contains("kind") ? value_of<std::string>(values["kind"], "kind") : "";
    ElementNumbers numbers;
    for (const auto& [key, value] : values) {
        const auto name = py::cast<std::string>(py::str(key));
        if (name != "kind") {
            numbers.emplace_back(name, flat(name, value));
        }
    }
    if (!values.contains("position")) {
        numbers.emplace_back("position", std::vector<double>{0, 0, 0});
    }
    try {
        return element_of(word, numbers);
    } catch (const Error& error) {
        throw Error(ErrorCode::usage, fmt::format("an element: {}", error.what()));
    }
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

py::dict numbers_of_kinds() {
    py::dict kinds;
    for (const Element::Kind kind : every_kind()) {
        const auto names = number_names(kind);
        py::tuple numbers(names.size());
        for (std::size_t i = 0; i < names.size(); ++i) {
            numbers[i] = py::str(names[i].data(), names[i].size());
        }
        kinds[to_string(kind)] = numbers;
    }
    return kinds;
}

} // namespace foam::python
