#include "builder.hpp"

#include <foam/geometry/polygon.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace foam::load_mesh {
namespace {

std::uint64_t hash(const Vec3& p) {
    std::uint64_t h = 0x9E3779B97F4A7C15u;
    for (const double coordinate : {p.x, p.y, p.z}) {
        h = Random(h ^ std::bit_cast<std::uint64_t>(coordinate)).bits();
    }
    return h;
}

} // namespace

MeshBuilder::MeshBuilder(const Source& source, const Limits& limits, Context& context)
    : source_(source), limits_(limits), context_(context), polygon_work_(limits.polygon_work), table_(1024) {}

std::size_t MeshBuilder::slot(const Vec3& point) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = hash(point) & mask;
    while (table_[at] != 0 && mesh_.vertices[table_[at] - 1] != point) {
        at = (at + 1) & mask;
    }
    return at;
}

void MeshBuilder::grow() {
    table_.assign(table_.size() * 2, 0);
    for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
        table_[slot(mesh_.vertices[i])] = static_cast<std::uint32_t>(i + 1);
    }
}

std::uint32_t MeshBuilder::vertex(const Vec3& point) {
    const Vec3 p{point.x + 0.0, point.y + 0.0, point.z + 0.0}; // -0 becomes 0
    std::size_t at = slot(p);
    if (table_[at] == 0) {
        if (mesh_.vertices.size() > 0xFFFFFFF0u) {
            throw source_.error("more than 2^32 vertices");
        }
        mesh_.vertices.push_back(p);
        if (mesh_.vertices.size() * 2 > table_.size()) {
            grow();
            at = slot(p);
        }
        table_[at] = static_cast<std::uint32_t>(mesh_.vertices.size());
    }
    return table_[at] - 1;
}

void MeshBuilder::expect_triangles(std::uint64_t count) const {
    if (count > limits_.max_triangles) {
        throw source_.error(
            fmt::format("more than {} triangles; remedy: simplify the mesh, or raise max_triangles of load.mesh",
                        limits_.max_triangles));
    }
}

void MeshBuilder::reserve_triangles(std::size_t count) {
    mesh_.triangles.reserve(count);
    mesh_.vertices.reserve(count / 2 + count / 16 + 8);
    if (mesh_.vertices.empty()) {
        table_.assign(std::max(table_.size(), std::bit_ceil(count + count / 8)), 0);
    }
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    expect_triangles(mesh_.triangles.size() + 1);
    if (mesh_.triangles.size() % 65536 == 65535) {
        context_.check_cancelled();
    }
    mesh_.triangles.push_back({a, b, c});
    if (colour_ != 0) {
        colours_.resize(mesh_.triangles.size());
        colours_.back() = colour_;
    }
}

void MeshBuilder::polygon(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
        triangle(corners[0], corners[1], corners[2]);
        return;
    }
    std::vector<Vec3> points;
    points.reserve(corners.size());
    for (const std::uint32_t corner : corners) {
        points.push_back(mesh_.vertices[corner]);
    }
    const std::vector<Triangle> triangles = triangulated(points, polygon_work_);
    if (triangles.empty()) {
        throw source_.error(
            fmt::format("a polygon of {} corners is too tangled to be cut into triangles; remedy: export triangles",
                        corners.size()));
    }
    for (const auto& [a, b, c] : triangles) {
        triangle(corners[a], corners[b], corners[c]);
    }
}

Mesh MeshBuilder::take() {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    Mesh result;
    std::vector<std::uint32_t> renumbered(mesh_.vertices.size(), unused);
    result.triangles = std::move(mesh_.triangles);
    for (Triangle& triangle : result.triangles) {
        for (std::uint32_t& corner : triangle) {
            if (renumbered[corner] == unused) {
                renumbered[corner] = static_cast<std::uint32_t>(result.vertices.size());
                result.vertices.push_back(mesh_.vertices[corner]);
            }
            corner = renumbered[corner];
        }
    }
    mesh_ = {};
    table_.assign(1024, 0);
    return result;
}

} // namespace foam::load_mesh
