// The stages of the plugins, and what loaders read.
#pragma once

#include <pybind11/pybind11.h>

namespace foam::python {

void add_stages(pybind11::module_& module);

} // namespace foam::python
