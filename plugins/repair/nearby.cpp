#include "octree.hpp"

#include <foam/base/parallel.hpp>

namespace foam::repair {

Nearby::Nearby(const Mesh& input, const VoxelSurface& surface, const Octree& octree) {
    items_.reserve(input.triangles.size());
    for (const Triangle& t : input.triangles) {
        const Corners c = corners(input, t);
        const Vec3 center = (c[0] + c[1] + c[2]) / 3;
        const double radius = std::max({distance(c[0], center), distance(c[1], center), distance(c[2], center)});
        items_.push_back({c, center, radius});
    }
    lists_.resize(surface.mesh.vertices.size());
    parallel_for(lists_.size(), [&](std::size_t i) { collect(static_cast<std::uint32_t>(i), surface, octree); });
}

void Nearby::collect(std::uint32_t vertex, const VoxelSurface& surface, const Octree& octree) {
    std::vector<Cell> cells = surface.cells[vertex];
    const Vec3 p = surface.mesh.vertices[vertex] / octree.cell_size();
    const auto is_near = [&](const Cell& cell, std::size_t axis) {
        // The middles of the eight cells are half a cell away, those for the midpoint of a face or side up to one.
        return std::abs(cell[axis] + 0.5 - p[static_cast<int>(axis)]) < 1.25;
    };
    for (std::size_t k = 0; k < cells.size(); ++k) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                Cell next = cells[k];
                next[axis] += step;
                if (is_near(next, axis) && octree.is_solid(next) &&
                    std::find(cells.begin(), cells.end(), next) == cells.end()) {
                    cells.push_back(next);
                }
            }
        }
    }
    std::vector<std::uint32_t>& list = lists_[vertex];
    for (const Cell& cell : cells) {
        const auto triangles = octree.triangles_at(cell);
        list.insert(list.end(), triangles.begin(), triangles.end());
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

Foot Nearby::closest(std::uint32_t vertex, const Vec3& p) const {
    Foot foot;
    double least = foot.distance; // squared
    for (const std::uint32_t t : lists_[vertex]) {
        const Item& item = items_[t];
        const double reach = foot.distance + item.radius;
        if (squared_norm(p - item.center) > reach * reach) {
            continue;
        }
        const Vec3 q = closest_point(item.corners, p);
        const double d = squared_norm(p - q);
        if (d < least) {
            least = d;
            foot = {q, std::sqrt(d)};
        }
    }
    return foot;
}

bool Nearby::is_crossed(std::uint32_t vertex, const Vec3& a, const Vec3& b) const {
    const Vec3 middle = (a + b) * 0.5;
    const double half = distance(a, b) / 2;
    return std::any_of(lists_[vertex].begin(), lists_[vertex].end(), [&](std::uint32_t t) {
        const Item& item = items_[t];
        const double reach = half + item.radius;
        return squared_norm(middle - item.center) <= reach * reach && crosses(item.corners, a, b);
    });
}

} // namespace foam::repair
