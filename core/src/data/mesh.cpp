#include <foam/error.hpp>
#include <foam/mesh.hpp>

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace foam {

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
        // Differences of corners first: exact enough for triangles that are small against the whole.
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
    mesh.triangles.reserve(mesh.triangles.size() + other.triangles.size());
    for (const auto& [a, b, c] : other.triangles) {
        mesh.triangles.push_back({a + offset, b + offset, c + offset});
    }
}

Mesh welded(const Mesh& mesh) {
    const auto less = [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
    std::map<Vec3, std::uint32_t, decltype(less)> index_of(less);
    Mesh result;
    for (const Triangle& triangle : mesh.triangles) {
        Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            Vec3 v = mesh.vertices[triangle[k]];
            v = {v.x + 0.0, v.y + 0.0, v.z + 0.0}; // -0 becomes 0
            t[k] = index_of.try_emplace(v, static_cast<std::uint32_t>(index_of.size())).first->second;
        }
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            result.triangles.push_back(t);
        }
    }
    // Number the vertices that are left in the order of their first use.
    std::vector<Vec3> points(index_of.size());
    for (const auto& [point, index] : index_of) {
        points[index] = point;
    }
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    std::vector<std::uint32_t> renumbered(points.size(), unused);
    for (Triangle& t : result.triangles) {
        for (std::uint32_t& corner : t) {
            if (renumbered[corner] == unused) {
                renumbered[corner] = static_cast<std::uint32_t>(result.vertices.size());
                result.vertices.push_back(points[corner]);
            }
            corner = renumbered[corner];
        }
    }
    return result;
}

} // namespace foam
