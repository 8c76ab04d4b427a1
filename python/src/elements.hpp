// Elements of other kinds than sphere, as dictionaries of Python.
#pragma once

#include <foam/sdk/model.hpp>

#include <pybind11/pybind11.h>

namespace foam::python {

namespace py = pybind11;

/// Returns {"kind", "position", "rotation": rows, …}: "radius" and "length" (of the axis, without caps) for capsules and
/// cylinders, "size" (of the box) for boxes and swept boxes, with "radius" for the latter, "vertices" for hulls.
py::dict dict_of(const Element& element);
/// Returns the element of such a dictionary. Throws Error(usage) for a key that is missing or unknown, and for numbers
/// of no body.
Element element_of_dict(const py::dict& values);

/// Returns [(link, [dictionary, …]), …] of the links with such elements.
py::list elements_of(const SphereFile& file);
/// Returns the elements of a model by link, in the order of their first groups.
SphereFile file_of_model(const SphereModel& model);

} // namespace foam::python
