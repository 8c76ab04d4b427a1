#include "drawn_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace foam::inline view {
namespace {

constexpr double smooth_cosine = 0.77;      ///< of about 40°
constexpr std::size_t most_neighbours = 64; ///< around a vertex with more faces (a fan) each face has its own normal

/// Returns twice the area of each triangle times its unit normal.
std::vector<Vec3> area_vectors(const Mesh& mesh) {
    std::vector<Vec3> areas;
    areas.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        areas.push_back(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
    }
    return areas;
}

/// The triangles around each vertex.
struct Incidence {
    std::vector<std::uint32_t> first, triangles; ///< those of vertex v begin at first[v]

    explicit Incidence(const Mesh& mesh) : first(mesh.vertices.size() + 1), triangles(3 * mesh.triangles.size()) {
        for (const Triangle& triangle : mesh.triangles) {
            for (const std::uint32_t corner : triangle) {
                ++first[corner + 1];
            }
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            for (const std::uint32_t corner : mesh.triangles[t]) {
                triangles[next[corner]++] = t;
            }
        }
    }

    std::span<const std::uint32_t> around(std::uint32_t vertex) const {
        return std::span(triangles).subspan(first[vertex], first[vertex + 1] - first[vertex]);
    }
};

std::array<std::int8_t, 2> octahedral(const Vec3& n) {
    const double size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(size > 0)) {
        return {0, 0};
    }
    double u = n.x / size, v = n.y / size;
    if (n.z < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1);
        u = folded;
    }
    return {static_cast<std::int8_t>(std::lround(127 * u)), static_cast<std::int8_t>(std::lround(127 * v))};
}

/// The order of the triangles: those of one colour together, else as in the file.
std::vector<std::uint32_t> order_of(const ViewedMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.mesh->triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!mesh.colours.empty()) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return mesh.colours[a] < mesh.colours[b]; });
    }
    return order;
}

class Drawing {
public:
    explicit Drawing(const ViewedMesh& mesh)
        : mesh_(mesh), areas_(area_vectors(*mesh.mesh)), incidence_(*mesh.mesh),
          of_vertex_(mesh.mesh->vertices.size(), none) {
        const Box box = bounds(*mesh.mesh);
        const Vec3 size = box.size();
        result_.low = box.empty() ? Vec3{} : box.low;
        result_.step = std::max({size.x, size.y, size.z}) / 65535;
        result_.vertices.reserve(mesh.mesh->vertices.size() * 5 / 4);
        next_.reserve(mesh.mesh->vertices.size() * 5 / 4);
        result_.corners.reserve(3 * mesh.mesh->triangles.size());
    }

    DrawnMesh run() {
        for (const std::uint32_t t : order_of(mesh_)) {
            if (areas_[t] == Vec3{}) {
                continue;
            }
            begin_range(mesh_.colours.empty() ? 0 : mesh_.colours[t]);
            for (const std::uint32_t corner : mesh_.mesh->triangles[t]) {
                result_.corners.push_back(vertex(corner, {place(mesh_.mesh->vertices[corner]), normal(corner, t)}));
            }
            result_.ranges.back().count += 3;
        }
        return std::move(result_);
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFFu;

    void begin_range(Colour colour) {
        const std::optional<Colour> own = colour == 0 ? std::nullopt : std::optional(colour);
        if (result_.ranges.empty() || result_.ranges.back().colour != own) {
            result_.ranges.push_back({result_.corners.size(), 0, own});
        }
    }

    std::array<std::uint16_t, 3> place(const Vec3& point) const {
        std::array<std::uint16_t, 3> place{};
        for (int axis = 0; axis < 3; ++axis) {
            const double at = result_.step > 0 ? std::round((point[axis] - result_.low[axis]) / result_.step) : 0;
            place[static_cast<std::size_t>(axis)] = static_cast<std::uint16_t>(std::clamp(at, 0.0, 65535.0));
        }
        return place;
    }

    std::array<std::int8_t, 2> normal(std::uint32_t corner, std::uint32_t t) const {
        const auto around = incidence_.around(corner);
        if (around.size() > most_neighbours) {
            return octahedral(areas_[t]);
        }
        const double own = norm(areas_[t]);
        Vec3 sum;
        for (const std::uint32_t other : around) {
            if (dot(areas_[other], areas_[t]) >= smooth_cosine * own * norm(areas_[other])) {
                sum += areas_[other];
            }
        }
        return octahedral(sum);
    }

    /// Returns the index of the vertex; corners of one vertex with one normal share it.
    std::uint32_t vertex(std::uint32_t corner, const DrawnVertex& wanted) {
        for (std::uint32_t v = of_vertex_[corner]; v != none; v = next_[v]) {
            if (result_.vertices[v] == wanted) {
                return v;
            }
        }
        const auto fresh = static_cast<std::uint32_t>(result_.vertices.size());
        result_.vertices.push_back(wanted);
        next_.push_back(of_vertex_[corner]);
        of_vertex_[corner] = fresh;
        return fresh;
    }

    const ViewedMesh& mesh_;
    std::vector<Vec3> areas_;
    Incidence incidence_;
    std::vector<std::uint32_t> of_vertex_, next_; ///< lists of drawn vertices by vertex of the mesh
    DrawnMesh result_;
};

} // namespace

DrawnMesh drawn(const ViewedMesh& mesh) {
    return Drawing(mesh).run();
}

} // namespace foam::inline view
