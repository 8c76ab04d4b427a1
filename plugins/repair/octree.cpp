#include "octree.hpp"

#include "soup.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>

namespace foam::repair {
namespace {

constexpr int max_depth = 20;
/// Factor on the size of cells in tests: rounding must not lose a triangle between two of them.
constexpr double margin = 1 + 1e-9;

Cell child_place(const Cell& parent, int child) {
    return {2 * parent[0] + (child & 1), 2 * parent[1] + (child >> 1 & 1), 2 * parent[2] + (child >> 2 & 1)};
}

using Lists = std::array<std::vector<std::uint32_t>, 8>;

/// Returns whether the box lies in the cube.
bool is_in_cube(const Box& box, const Vec3& center, double half_size) {
    const Vec3 low = box.low - center, high = box.high - center;
    return std::min({low.x, low.y, low.z}) >= -half_size && std::max({high.x, high.y, high.z}) <= half_size;
}

/// Returns the triangles of a node, distributed to its children.
Lists deal(const Mesh& mesh, const Node& node, std::span<const std::uint32_t> triangles) {
    Lists lists;
    const double size = std::ldexp(1.0, -(node.level + 1));
    std::array<Vec3, 8> centers;
    for (int child = 0; child < 8; ++child) {
        const Cell place = child_place(node.place, child);
        centers[static_cast<std::size_t>(child)] = Vec3{place[0] + 0.5, place[1] + 0.5, place[2] + 0.5} * size;
    }
    const Vec3 middle = (centers[0] + centers[7]) * 0.5;
    CancellationCounter asking(4096);
    for (const std::uint32_t t : triangles) {
        asking.check();
        const Corners c = corners(mesh, mesh.triangles[t]);
        Box box;
        for (const Vec3& p : c) {
            box.add(p);
        }
        // Most triangles are small, and lie in the one child that contains their middle.
        const Vec3 p = box.center();
        const std::size_t home = (p.x > middle.x) + 2 * (p.y > middle.y) + 4 * (p.z > middle.z);
        const double reach = std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z}) / 2;
        const Vec3 away = p - middle;
        const double clear = std::min({std::abs(away.x), std::abs(away.y), std::abs(away.z)}) - reach;
        if (clear > size * (margin - 1) && is_in_cube(box, centers[home], size / 2)) {
            lists[home].push_back(t);
            continue;
        }
        for (std::size_t child = 0; child < 8; ++child) {
            if (overlaps_cube(c, centers[child], size / 2 * margin)) {
                lists[child].push_back(t);
            }
        }
    }
    return lists;
}

} // namespace

Octree::Octree(const Mesh& mesh, std::size_t leaves, Context& context) {
    nodes_.push_back({0, State::occupied, 0, {}});
    std::vector<std::uint32_t> frontier = {0};
    offsets_ = {0, static_cast<std::uint32_t>(mesh.triangles.size())};
    triangles_.resize(mesh.triangles.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        triangles_[t] = t;
    }
    while (frontier.size() < leaves && depth_ < max_depth) {
        context.check_cancelled();
        std::vector<Lists> dealt(frontier.size());
        parallel_for(frontier.size(), [&](std::size_t k) {
            dealt[k] = deal(mesh, nodes_[frontier[k]],
                            std::span(triangles_).subspan(offsets_[k], offsets_[k + 1] - offsets_[k]));
        });
        std::vector<std::uint32_t> next;
        offsets_ = {0};
        triangles_.clear();
        for (std::size_t k = 0; k < frontier.size(); ++k) {
            const std::uint32_t first = split(frontier[k]);
            for (std::uint32_t child = 0; child < 8; ++child) {
                const std::vector<std::uint32_t>& list = dealt[k][child];
                if (!list.empty()) {
                    nodes_[first + child].state = State::occupied;
                    nodes_[first + child].first_child = static_cast<std::uint32_t>(next.size());
                    next.push_back(first + child);
                    triangles_.insert(triangles_.end(), list.begin(), list.end());
                    offsets_.push_back(static_cast<std::uint32_t>(triangles_.size()));
                }
            }
        }
        frontier = std::move(next);
        ++depth_;
    }
}

std::uint32_t Octree::node_at(const Cell& place, int level) const {
    std::uint32_t node = 0;
    for (int bit = level - 1; bit >= 0 && nodes_[node].state == State::split; --bit) {
        const int child = (place[0] >> bit & 1) | (place[1] >> bit & 1) << 1 | (place[2] >> bit & 1) << 2;
        node = nodes_[node].first_child + static_cast<std::uint32_t>(child);
    }
    return node;
}

bool Octree::holds(const Cell& place, int level) const {
    const std::int32_t size = std::int32_t{1} << level;
    return std::all_of(place.begin(), place.end(), [&](std::int32_t c) { return c >= 0 && c < size; });
}

bool Octree::is_solid(const Cell& cell) const {
    return holds(cell, depth_) && nodes_[node_at(cell, depth_)].state != State::outside;
}

std::span<const std::uint32_t> Octree::triangles_at(const Cell& cell) const {
    if (!holds(cell, depth_)) {
        return {};
    }
    const Node& node = nodes_[node_at(cell, depth_)];
    if (node.state != State::occupied) {
        return {};
    }
    const std::uint32_t begin = offsets_[node.first_child], end = offsets_[node.first_child + 1];
    return std::span(triangles_).subspan(begin, end - begin);
}

Cell Octree::low_cell(const Node& node) const {
    const int shift = depth_ - node.level;
    return {node.place[0] << shift, node.place[1] << shift, node.place[2] << shift};
}

std::uint32_t Octree::split(std::uint32_t leaf) {
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    const Node parent = nodes_[leaf];
    nodes_[leaf].state = State::split;
    nodes_[leaf].first_child = first;
    for (int child = 0; child < 8; ++child) {
        nodes_.push_back(
            {0, State::enclosed, static_cast<std::uint8_t>(parent.level + 1), child_place(parent.place, child)});
    }
    return first;
}

} // namespace foam::repair
