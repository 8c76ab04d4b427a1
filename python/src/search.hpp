// foam::spherize() and its relatives.
#pragma once

#include <pybind11/pybind11.h>

namespace foam::python {

void add_search(pybind11::module_& module);

} // namespace foam::python
