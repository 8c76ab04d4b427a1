#include <foam/geometry/internal/compared_mesh.hpp>

#include <foam/base/cancellation.hpp>
#include <foam/geometry/internal/triangle.hpp>

namespace foam::inline geometry {

const Mesh& ComparedMesh::welded() {
    if (!welded_) {
        welded_ = foam::welded(mesh_);
    }
    return *welded_;
}

const Topology& ComparedMesh::defects() {
    if (!defects_) {
        defects_ = topology(mesh_);
        if (!defects_->closed_manifold()) {
            defects_ = topology(welded());
        }
    }
    return *defects_;
}

std::optional<double> ComparedMesh::volume() {
    return defects().closed() && defects().oriented() ? std::optional(signed_volume(mesh_)) : std::nullopt;
}

void ComparedMesh::prepare_distances() {
    if (bvh_) {
        return;
    }
    std::vector<Box> boxes(mesh_.triangles.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const std::uint32_t corner : mesh_.triangles[i]) {
            boxes[i].add(mesh_.vertices[corner]);
        }
    }
    check_cancelled();
    bvh_ = Bvh::quick(boxes, 8);
}

double ComparedMesh::distance(const Vec3& point) const {
    double least = std::numeric_limits<double>::infinity(); // squared
    for_each_nearer(
        *bvh_, point, [&] { return least; },
        [&](std::uint32_t k) {
            const auto& [a, b, c] = mesh_.triangles[bvh_->order()[k]];
            const Corners corners{mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
            least = std::min(least, squared_norm(closest_on_triangle(corners, point) - point));
        });
    return std::sqrt(least);
}

} // namespace foam::geometry
