#include "part.hpp"

#include <foam/base/cancellation.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::load_mesh {
namespace {

Vec3 placed(const Part& part, std::size_t i, const Affine& pose) {
    const Vec3 &raw = part.points[i], p = pose * raw;
    if (!is_finite(raw)) {
        throw part.error(i, fmt::format("is not finite: {}; remedy: export the mesh again without it", text_of(raw)));
    }
    if (!is_finite(p)) {
        throw part.error(i, fmt::format("is not finite where its node puts it: {}; remedy: export the mesh again with "
                                        "a smaller scale",
                                        text_of(p)));
    }
    return p;
}

} // namespace

Part compacted(Part part) {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    std::vector<std::uint32_t> renumbered(part.points.size(), unused), original;
    std::vector<Vec3> points;
    for (std::uint32_t& corner : part.corners) {
        std::uint32_t& number = renumbered[corner];
        if (number == unused) {
            number = static_cast<std::uint32_t>(points.size());
            points.push_back(part.points[corner]);
            original.push_back(corner);
        }
        corner = number;
    }
    part.points = std::move(points);
    part.error = [original = std::move(original), error = std::move(part.error)](
                     std::size_t i, const std::string& what) { return error(original[i], what); };
    return part;
}

void place(const Part& part, const Affine& pose, MeshBuilder& builder) {
    constexpr std::uint32_t unused = 0xFFFFFFFFu;
    std::vector<std::uint32_t> vertices(part.points.size(), unused), polygon;
    const bool mirrors = pose.mirrors();
    auto corner = part.corners.begin();
    CancellationCounter asking(4096);
    for (const std::uint32_t size : part.sizes) {
        asking.check();
        polygon.clear();
        for (const auto end = corner + size; corner != end; ++corner) {
            std::uint32_t& vertex = vertices[*corner];
            vertex = vertex == unused ? builder.vertex(placed(part, *corner, pose)) : vertex;
            polygon.push_back(vertex);
        }
        if (mirrors) {
            std::reverse(polygon.begin(), polygon.end());
        }
        builder.polygon(polygon);
    }
}

} // namespace foam::load_mesh
