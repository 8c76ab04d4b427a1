#include <foam/base/error.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh.hpp>

#include <fmt/format.h>

namespace foam::inline geometry {

void check_corners(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t corner : mesh.triangles[i]) {
            if (corner >= mesh.vertices.size()) {
                throw Error(ErrorCode::geometry, fmt::format("triangle {} refers to vertex {}, but there are only {}",
                                                             i, corner, mesh.vertices.size()));
            }
            if (!is_finite(mesh.vertices[corner])) {
                throw Error(ErrorCode::geometry,
                            fmt::format("vertex {} of the mesh is not finite; remove its triangles or repair the file",
                                        corner));
            }
        }
    }
}

Box bounds(const Mesh& mesh) {
    Box box;
    for (const Vec3& vertex : mesh.vertices) {
        box.add(vertex);
    }
    return box;
}

double surface_area(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3& p = mesh.vertices[a];
        sum += norm(cross(mesh.vertices[b] - p, mesh.vertices[c] - p));
    }
    return sum / 2;
}

double signed_volume(const Mesh& mesh) {
    // About the centre, so that a part far from the origin keeps its digits.
    const Vec3 center = mesh.vertices.empty() ? Vec3{} : bounds(mesh).center();
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
        // Differences of corners first: accurate for triangles that are small compared with the mesh.
        const Vec3& p = mesh.vertices[a];
        sum += dot(p - center, cross(mesh.vertices[b] - p, mesh.vertices[c] - p));
    }
    return sum / 6;
}

Mesh transformed(const Mesh& mesh, const Pose& pose, const Vec3& scale) {
    Mesh result = mesh;
    for (Vec3& v : result.vertices) {
        v = pose * Vec3{v.x * scale.x, v.y * scale.y, v.z * scale.z};
    }
    if (scale.x * scale.y * scale.z < 0) {
        for (Triangle& t : result.triangles) {
            std::swap(t[1], t[2]);
        }
    }
    return result;
}

void append(Mesh& mesh, const Mesh& other) {
    const auto offset = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
    if (const std::size_t all = mesh.triangles.size() + other.triangles.size(); all > mesh.triangles.capacity()) {
        mesh.triangles.reserve(std::max(all, 2 * mesh.triangles.capacity())); // amortised growth
    }
    for (const auto& [a, b, c] : other.triangles) {
        mesh.triangles.push_back({a + offset, b + offset, c + offset});
    }
}

Mesh welded(const Mesh& mesh) {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    const std::vector<std::uint32_t> first_at = geometry::welded_indices(mesh);
    std::vector<std::uint32_t> number(mesh.vertices.size(), unused);
    Mesh result;
    result.triangles.reserve(mesh.triangles.size());
    for (const auto& [i, j, k] : mesh.triangles) {
        Triangle t{first_at[i], first_at[j], first_at[k]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
            continue;
        }
        for (std::uint32_t& corner : t) {
            if (number[corner] == unused) {
                const Vec3& v = mesh.vertices[corner];
                number[corner] = static_cast<std::uint32_t>(result.vertices.size());
                result.vertices.push_back({v.x + 0.0, v.y + 0.0, v.z + 0.0}); // -0 becomes 0
            }
            corner = number[corner];
        }
        result.triangles.push_back(t);
    }
    return result;
}

} // namespace foam::geometry
