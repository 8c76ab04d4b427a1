// Meshes and other arrays between Python and C++.
#pragma once

#include "work.hpp"

#include <foam/geometry/solid.hpp>

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
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

/// A mesh that was copied from arrays, and the solid of it, which is made when it is first needed.
class HeldMesh {
public:
    explicit HeldMesh(Mesh mesh) : mesh_(std::make_shared<const Mesh>(std::move(mesh))) {}
    explicit HeldMesh(std::shared_ptr<const Solid> solid);

    const std::shared_ptr<const Mesh>& mesh() const { return mesh_; }
    /// Any thread may call it, without the interpreter's lock. Throws as Solid::make does.
    std::shared_ptr<const Solid> solid() const;

private:
    std::shared_ptr<const Mesh> mesh_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Solid> solid_;
};

void add_mesh(py::module_& module);

} // namespace foam::python
