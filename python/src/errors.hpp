// foam::Error as the exceptions of foam/errors.py.
#pragma once

#include <pybind11/pybind11.h>

namespace foam::python {

void add_errors(pybind11::module_& module);

} // namespace foam::python
