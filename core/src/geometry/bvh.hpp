// A flat bounding-volume hierarchy over boxes.
#pragma once

#include <foam/vector.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace foam::geometry {

/// Two children lie side by side at `first` and `first + 1`; a leaf holds the items order()[first … first + count).
struct BvhNode {
    Vec3 low, high;
    std::uint32_t first = 0, count = 0;

    bool leaf() const { return count > 0; }
};

/// Node 0 is the root. The same for the same boxes.
class Bvh {
public:
    /// No path from the root is longer: traversal stacks of this size never overflow.
    static constexpr std::size_t max_depth = 96;

    Bvh() = default;
    /// Top-down by the binned surface-area heuristic (Wald 2007): for many queries.
    explicit Bvh(std::span<const Box> boxes, std::uint32_t leaf_size = 4);
    /// Along a Morton curve through the boxes' centres (Lauterbach, Garland, Sengupta, Luebke, Manocha: Fast BVH
    /// Construction on GPUs, 2009, section 4): built several times as fast, for queries that are fewer than the boxes.
    static Bvh quick(std::span<const Box> boxes, std::uint32_t leaf_size = 4);

    const std::vector<BvhNode>& nodes() const { return nodes_; }
    const std::vector<std::uint32_t>& order() const { return order_; }

private:
    std::vector<BvhNode> nodes_;
    std::vector<std::uint32_t> order_;
};

/// Squared distance from a point to a node's box; 0 inside.
inline double squared_distance(const BvhNode& node, const Vec3& p) {
    const double dx = std::max(std::max(node.low.x - p.x, p.x - node.high.x), 0.0);
    const double dy = std::max(std::max(node.low.y - p.y, p.y - node.high.y), 0.0);
    const double dz = std::max(std::max(node.low.z - p.z, p.z - node.high.z), 0.0);
    return dx * dx + dy * dy + dz * dz;
}

/// Calls visit(k) for the places k in order() of the items in leaves whose box is nearer to `p` than nearest(), the
/// nearer child first. `nearest`: the least squared distance known so far.
template <class Nearest, class Visit>
void for_each_nearer(const Bvh& bvh, const Vec3& p, Nearest nearest, Visit visit) {
    struct Waiting {
        double squared_distance;
        std::uint32_t node;
    };
    const std::vector<BvhNode>& nodes = bvh.nodes();
    std::array<Waiting, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size++] = {squared_distance(nodes[0], p), 0};
    while (size > 0) {
        const Waiting waiting = stack[--size];
        if (!(waiting.squared_distance < nearest())) {
            continue;
        }
        const BvhNode& node = nodes[waiting.node];
        if (!node.leaf()) {
            const Waiting first{squared_distance(nodes[node.first], p), node.first};
            const Waiting second{squared_distance(nodes[node.first + 1], p), node.first + 1};
            const bool ordered = first.squared_distance <= second.squared_distance;
            stack[size++] = ordered ? second : first; // the nearer one is looked at first
            stack[size++] = ordered ? first : second;
            continue;
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            visit(k);
        }
    }
}

} // namespace foam::geometry
