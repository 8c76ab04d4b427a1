// A flat bounding-volume hierarchy over boxes.
#pragma once

#include <foam/vector.hpp>

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

/// Built top-down by the binned surface-area heuristic (Wald 2007), the same for the same boxes. Node 0 is the root.
class Bvh {
public:
    /// No path from the root is longer: traversal stacks of this size never overflow.
    static constexpr std::size_t max_depth = 96;

    Bvh() = default;
    explicit Bvh(std::span<const Box> boxes, std::uint32_t leaf_size = 4);

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

} // namespace foam::geometry
