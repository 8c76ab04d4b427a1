#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/bvh.hpp>
#include <foam/geometry/internal/triangles.hpp>
#include <foam/geometry/mesh_checks.hpp>

namespace foam::inline geometry {
namespace {

TriangleCorners corners_of(const Mesh& mesh, std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/// Returns whether a side of triangle i passes through triangle k. Sides that start at a corner of k only touch it
/// there.
bool side_passes_through(const Mesh& mesh, std::uint32_t i, std::uint32_t k) {
    const Triangle &sides = mesh.triangles[i], &other = mesh.triangles[k];
    std::array<bool, 3> shared{};
    for (std::size_t s = 0; s < 3; ++s) {
        shared[s] = sides[s] == other[0] || sides[s] == other[1] || sides[s] == other[2];
    }
    return shared[0] + shared[1] + shared[2] < 2 &&
           geometry::side_passes_through(corners_of(mesh, i), corners_of(mesh, k), shared);
}

} // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> self_intersections(const Mesh& mesh) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Box> boxes(count);
    CancellationCounter asking(4096);
    for (std::size_t i = 0; i < count; ++i) {
        asking.check();
        for (const std::uint32_t corner : mesh.triangles[i]) {
            boxes[i].add(mesh.vertices[corner]);
        }
    }
    const Bvh bvh = Bvh::quick(boxes);
    std::vector<std::vector<std::uint32_t>> found(count);
    parallel_for(count, [&](std::size_t index) {
        const auto i = static_cast<std::uint32_t>(index);
        const auto is_near = [&](const BvhNode& node) { return overlap(node, boxes[index]); };
        geometry::for_each_entered(bvh, is_near, [&](std::uint32_t place) {
            const std::uint32_t k = bvh.order()[place];
            if (k > i && overlap(boxes[k], boxes[i]) &&
                (side_passes_through(mesh, i, k) || side_passes_through(mesh, k, i))) {
                found[index].push_back(k);
            }
        });
        std::sort(found[index].begin(), found[index].end());
    });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const std::uint32_t k : found[i]) {
            pairs.emplace_back(i, k);
        }
    }
    return pairs;
}

} // namespace foam::inline geometry
