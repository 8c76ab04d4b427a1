// Meshes, elements and robots as Python holds them.
#pragma once

#include "work.hpp"

#include <foam/geometry/solid.hpp>
#include <foam/judge/evaluate.hpp>
#include <foam/sdk/model.hpp>
#include <foam/sdk/registry.hpp>

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace foam::python {

/// Numbers that Python sees as a read-only buffer of shape (rows, columns), without a copy.
class Rows {
public:
    Rows(std::shared_ptr<const void> owner, const double* data, std::size_t rows, std::size_t columns)
        : owner_(std::move(owner)), data_(data), format_(py::format_descriptor<double>::format()),
          size_(sizeof(double)), rows_(rows), columns_(columns) {}
    Rows(std::shared_ptr<const void> owner, const std::uint32_t* data, std::size_t rows, std::size_t columns)
        : owner_(std::move(owner)), data_(data), format_(py::format_descriptor<std::uint32_t>::format()),
          size_(sizeof(std::uint32_t)), rows_(rows), columns_(columns) {}

    py::buffer_info buffer() const;

private:
    std::shared_ptr<const void> owner_;
    const void* data_;
    std::string format_;
    std::size_t size_, rows_, columns_;
};

/// Returns spheres as rows of x, y, z, r.
Rows rows_of(std::vector<Sphere> spheres);
/// Returns the spheres of a C-contiguous buffer of float64, shape (n, 4).
std::vector<Sphere> spheres_of(const py::buffer& buffer);

/// A mesh or points that were copied from arrays, and the solid of them, which is made when it is first needed.
class HeldMesh {
public:
    explicit HeldMesh(Mesh mesh) : mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}
    explicit HeldMesh(std::shared_ptr<const Solid> solid) : solid_(std::move(solid)) {}
    /// Points with radii. Throws as solid_of_balls() does.
    explicit HeldMesh(std::vector<Sphere> seen);

    /// The points that it is made of; empty for any other.
    const std::vector<Sphere>& seen() const { return seen_; }
    /// Any thread may call these, without the interpreter's lock. They throw as Solid::make does.
    std::shared_ptr<const Mesh> mesh() const;
    std::shared_ptr<const Solid> solid() const;

private:
    std::shared_ptr<const Solid> made_solid() const;

    std::vector<Sphere> seen_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Mesh> mesh_;
    mutable std::shared_ptr<const Solid> solid_;
};

void add_mesh(py::module_& module);

namespace py = pybind11;

/// Returns {"kind", "position", "rotation": rows, …} with the numbers of its kind, by numbers_of_kinds().
py::dict dict_of(const Element& element);
/// Returns the element of such a dictionary. Throws Error(usage) for a key that is missing or unknown, and for numbers
/// of no body.
Element element_of_dict(const py::dict& values);
/// Returns {"capsule": ("length", "radius"), …}: the names of the numbers of each kind.
py::dict numbers_of_kinds();

/// Returns [(link, [dictionary, …]), …] of the links with such elements.
py::list elements_of(const SphereFile& file);
/// Returns the elements of a model by link, in the order of their first groups.
SphereFile file_of_model(const SphereModel& model);

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
