// Robots, and the spheres of their links.
#pragma once

#include "mesh.hpp"

#include <foam/judge/evaluate.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace foam::python {

/// A robot or a mesh that was read, with its meshes and the stages that read it.
struct HeldRobot {
    std::shared_ptr<Registry> registry;
    Original original;
};

/// A model as a writer takes it: that of a run, or of spheres from elsewhere.
struct HeldModel {
    std::shared_ptr<Registry> registry;
    SphereModel model;
    bool of_run = false; ///< proved by it
};

/// JSON text for Python.
template <class Json> std::string json_text(const Json& json) {
    return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

void add_robot(py::module_& module);
void add_judge(py::module_& module);
void add_writing(py::module_& module);
void add_runs(py::module_& module);
void add_old(py::module_& module);
void add_picture(py::module_& module);

} // namespace foam::python
