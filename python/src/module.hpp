// The parts of the module.
#pragma once

#include <foam/sdk/plugin.hpp>

#include <pybind11/pybind11.h>

#include <string>

namespace foam::python {

/// Returns the file of this module, which is also the plugin of these stages.
std::string own_file();
/// Returns whether a function of Python is registered.
bool has_own_stages();
/// Adds them to a registry.
void enrol_own_stages(Enrolment& enrol);
void add_own_stages(pybind11::module_& module);

void add_stages(pybind11::module_& module);

void add_search(pybind11::module_& module);

void add_errors(pybind11::module_& module);

} // namespace foam::python
