// Regions: what is to be covered.
#include "handles.hpp"
#include "reporting.hpp"

#include <foam/geometry/solid_of_balls.hpp>

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

namespace foam::c {

static void check_arrays(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                  std::size_t triangle_count) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (!vertices || !triangles) {
        throw usage(
            fmt::format("{} is NULL; remedy: an array of three numbers each", vertices ? "triangles" : "vertices"));
    }
    if (vertex_count > most || triangle_count > most) {
        throw usage(fmt::format("{} vertices and {} triangles; remedy: at most {} of each", vertex_count,
                                triangle_count, most));
    }
    if (triangle_count == 0) {
        throw Error(ErrorCode::geometry, "the mesh has no triangle; remedy: a mesh with a surface");
    }
}

Mesh mesh_of(const double* vertices, std::size_t vertex_count, const std::uint32_t* triangles,
                   std::size_t triangle_count) {
    check_arrays(vertices, vertex_count, triangles, triangle_count);
    Mesh mesh;
    mesh.triangles.resize(triangle_count);
    for (std::size_t t = 0; t < triangle_count; ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.triangles[t][k] = triangles[3 * t + k];
            if (mesh.triangles[t][k] >= vertex_count) {
                throw Error(ErrorCode::geometry,
                            fmt::format("triangle {} has the corner {}, but there are {} vertices; remedy: indices "
                                        "from 0 to vertex_count - 1",
                                        t, mesh.triangles[t][k], vertex_count));
            }
        }
    }
    mesh.vertices.resize(vertex_count);
    for (std::size_t v = 0; v < vertex_count; ++v) {
        const double* const p = vertices + 3 * v;
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) {
            throw Error(ErrorCode::geometry,
                        fmt::format("vertex {} is ({}, {}, {}); remedy: finite coordinates", v, p[0], p[1], p[2]));
        }
        mesh.vertices[v] = {p[0], p[1], p[2]};
    }
    return mesh;
}

static std::vector<Sphere> balls_of(const double* points, const double* radii, std::size_t count) {
    constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();
    if (count > most) {
        throw usage(fmt::format("count is {}; remedy: at most {} points", count, most));
    }
    if (!points && count > 0) {
        throw usage("points is NULL; remedy: an array of three numbers each");
    }
    std::vector<Sphere> balls;
    balls.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back({{points[3 * i], points[3 * i + 1], points[3 * i + 2]}, radii ? radii[i] : 0});
    }
    return balls;
}

} // namespace foam::c

using namespace foam::c;

std::shared_ptr<const foam::Solid> foam_region::solid() const {
    const std::lock_guard lock(mutex_);
    if (!solid_) {
        solid_ = foam::solid_of_balls(balls);
    }
    return solid_;
}

extern "C" {

int foam_region_of_mesh(const double* vertices, size_t vertex_count, const uint32_t* triangles, size_t triangle_count,
                        foam_region** region, foam_report* report) {
    return reported(report, [&] {
        require_place(region, "region");
        *region = new foam_region(foam::Solid::make(mesh_of(vertices, vertex_count, triangles, triangle_count)));
    });
}

int foam_region_of_points(const double* points, const double* radii, size_t count, foam_region** region,
                          foam_report* report) {
    return reported(report, [&] {
        require_place(region, "region");
        std::vector<foam::Sphere> balls = balls_of(points, radii, count);
        foam::require_balls(balls);
        *region = new foam_region(std::move(balls));
    });
}

void foam_region_free(foam_region* region) {
    delete region;
}
}
