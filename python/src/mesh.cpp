#include "robot.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/solid_of_balls.hpp>

#include <pybind11/stl.h>

#include <fmt/format.h>

#include <cstring>
#include <limits>

namespace foam::python {
namespace {

/// The arrays that foam/_arrays.py hands over; a caller of _core itself gets an error, too.
py::buffer_info contiguous(const py::buffer& buffer, const std::string& format, py::ssize_t columns, const char* what) {
    py::buffer_info info = buffer.request();
    const auto same_kind = [&] {
        return info.format == format || (format == "q" && info.format == "l" && sizeof(long) == sizeof(std::int64_t));
    };
    if (!same_kind() || info.ndim != 2 || info.shape[1] != columns ||
        (info.size > 0 && (info.strides[1] != info.itemsize || info.strides[0] != columns * info.itemsize))) {
        throw Error(ErrorCode::usage, fmt::format("{}: _core takes contiguous rows of {} numbers of format {}; remedy: "
                                                  "use foam.Mesh or foam.spherize()",
                                                  what, columns, format));
    }
    return info;
}

Mesh mesh_of(const py::buffer& vertices, const py::buffer& faces) {
    const py::buffer_info points = contiguous(vertices, "d", 3, "vertices"),
                          corners = contiguous(faces, "q", 3, "faces");
    if (points.shape[0] > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(ErrorCode::input, fmt::format("{} vertices are more than a mesh can have ({})", points.shape[0],
                                                  std::numeric_limits<std::uint32_t>::max()));
    }
    Mesh mesh;
    mesh.vertices.resize(static_cast<std::size_t>(points.shape[0]));
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    if (!mesh.vertices.empty()) {
        std::memcpy(mesh.vertices.data(), points.ptr, mesh.vertices.size() * sizeof(Vec3));
    }
    mesh.triangles.resize(static_cast<std::size_t>(corners.shape[0]));
    const auto* index = static_cast<const std::int64_t*>(corners.ptr);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (std::uint32_t& corner : mesh.triangles[i]) {
            if (*index < 0 || *index >= points.shape[0]) {
                throw Error(ErrorCode::input,
                            fmt::format("faces[{}] has the index {}, but there are {} vertices (0 to {}); remedy: {}",
                                        i, *index, points.shape[0], points.shape[0] - 1,
                                        *index == points.shape[0] ? "if indices begin with 1, subtract 1"
                                                                  : "check that vertices and faces belong together"));
            }
            corner = static_cast<std::uint32_t>(*index++);
        }
    }
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3& p = mesh.vertices[i];
        if (!is_finite(p)) {
            throw Error(ErrorCode::input, fmt::format("vertices[{}] is not finite: ({}, {}, {}); remedy: leave out the "
                                                      "faces with such vertices",
                                                      i, p.x, p.y, p.z));
        }
    }
    return mesh;
}

} // namespace

py::buffer_info Rows::buffer() const {
    const auto item = static_cast<py::ssize_t>(size_);
    return {const_cast<void*>(data_),
            item,
            format_,
            2,
            {static_cast<py::ssize_t>(rows_), static_cast<py::ssize_t>(columns_)},
            {static_cast<py::ssize_t>(columns_) * item, item},
            /*readonly=*/true};
}

Rows rows_of(std::vector<Sphere> spheres) {
    static_assert(sizeof(Sphere) == 4 * sizeof(double));
    const auto kept = std::make_shared<const std::vector<Sphere>>(std::move(spheres));
    return {kept, reinterpret_cast<const double*>(kept->data()), kept->size(), 4};
}

std::vector<Sphere> spheres_of(const py::buffer& buffer) {
    const py::buffer_info info = contiguous(buffer, "d", 4, "spheres");
    std::vector<Sphere> spheres(static_cast<std::size_t>(info.shape[0]));
    if (!spheres.empty()) {
        std::memcpy(static_cast<void*>(spheres.data()), info.ptr, spheres.size() * sizeof(Sphere));
    }
    return spheres;
}

HeldMesh::HeldMesh(std::vector<Sphere> seen) : seen_(std::move(seen)) {
    require_balls(seen_);
}

std::shared_ptr<const Solid> HeldMesh::made_solid() const {
    if (!solid_ && !seen_.empty()) {
        solid_ = solid_of_balls(seen_);
    } else if (!solid_) {
        Solid::Part part;
        part.mesh = mesh_;
        solid_ = Solid::make(std::vector<Solid::Part>{part});
    }
    return solid_;
}

std::shared_ptr<const Solid> HeldMesh::solid() const {
    const std::lock_guard lock(mutex_);
    return made_solid();
}

std::shared_ptr<const Mesh> HeldMesh::mesh() const {
    const std::lock_guard lock(mutex_);
    if (!mesh_) {
        const std::vector<Solid::Part>& parts = made_solid()->parts();
        mesh_ = parts.size() == 1 && parts[0].mesh ? parts[0].mesh : std::make_shared<const Mesh>(solid_->surface());
    }
    return mesh_;
}

void add_mesh(py::module_& module) {
    py::class_<Rows>(module, "Rows", py::buffer_protocol()).def_buffer(&Rows::buffer);
    py::class_<HeldMesh, std::shared_ptr<HeldMesh>>(module, "Mesh")
        .def(py::init([](const py::buffer& vertices, const py::buffer& faces) {
                 return std::make_shared<HeldMesh>(mesh_of(vertices, faces));
             }),
             py::arg("vertices"), py::arg("faces"))
        .def("vertices",
             [](const HeldMesh& held) {
                 const auto mesh = held.mesh();
                 return Rows(mesh, reinterpret_cast<const double*>(mesh->vertices.data()), mesh->vertices.size(), 3);
             })
        .def("faces",
             [](const HeldMesh& held) {
                 const auto mesh = held.mesh();
                 return Rows(mesh, reinterpret_cast<const std::uint32_t*>(mesh->triangles.data()),
                             mesh->triangles.size(), 3);
             })
        .def("volume",
             [](const HeldMesh& held) { return worked([&](const Signals&) { return held.solid()->volume(); }); })
        .def("area", [](const HeldMesh& held) { return surface_area(*held.mesh()); })
        // None where the solid is made of anything else.
        .def("balls",
             [](const HeldMesh& held) -> std::optional<Rows> {
                 std::optional<std::vector<Sphere>> balls =
                     balls_of(*held.solid(), std::numeric_limits<std::size_t>::max());
                 return balls ? std::optional(rows_of(std::move(*balls))) : std::nullopt;
             })
        .def("is_watertight", [](const HeldMesh& held) {
            return worked([&](const Signals&) {
                const Topology defects = topology(welded(*held.mesh()));
                return defects.closed() && defects.oriented();
            });
        });
}

} // namespace foam::python
