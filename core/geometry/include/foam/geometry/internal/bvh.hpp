// A flat bounding-volume hierarchy over boxes.
#pragma once

#include <foam/geometry/vector.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// A node of the hierarchy. Its two children are adjacent at `first` and `first + 1`; a leaf contains the items
/// order()[first … first + count).
struct BvhNode {
    Vec3 low, high;
    std::uint32_t first = 0, count = 0;

    bool leaf() const { return count > 0; }
};

/// A bounding-volume hierarchy. Node 0 is the root. Equal boxes give equal hierarchies.
class Bvh {
public:
    /// Longest path from the root: traversal stacks of this size never overflow.
    static constexpr std::size_t max_depth = 96;

    Bvh() = default;
    /// Builds top-down by the binned surface-area heuristic (Wald 2007): for many queries.
    explicit Bvh(std::span<const Box> boxes, std::uint32_t leaf_size = 4);
    /// Builds along a Morton curve through the boxes' centres (Lauterbach, Garland, Sengupta, Luebke, Manocha: Fast BVH
    /// Construction on GPUs, 2009, section 4). It is several times as fast to build, for fewer queries than boxes.
    static Bvh quick(std::span<const Box> boxes, std::uint32_t leaf_size = 4);

    const std::vector<BvhNode>& nodes() const { return nodes_; }
    const std::vector<std::uint32_t>& order() const { return order_; }

private:
    std::vector<BvhNode> nodes_;
    std::vector<std::uint32_t> order_;
};

/// Returns whether two boxes have a common point; either may be a node.
template <class A, class B> bool overlap(const A& a, const B& b) {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
           a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// Returns whether a point is in a node's box, or on its boundary.
inline bool contains(const BvhNode& node, const Vec3& p) {
    return p.x >= node.low.x && p.x <= node.high.x && p.y >= node.low.y && p.y <= node.high.y && p.z >= node.low.z &&
           p.z <= node.high.z;
}

/// Returns the squared distance from a point to a node's box; 0 inside.
inline double squared_distance(const BvhNode& node, const Vec3& p) {
    const double dx = std::max(std::max(node.low.x - p.x, p.x - node.high.x), 0.0);
    const double dy = std::max(std::max(node.low.y - p.y, p.y - node.high.y), 0.0);
    const double dz = std::max(std::max(node.low.z - p.z, p.z - node.high.z), 0.0);
    return dx * dx + dy * dy + dz * dz;
}

/// Calls visit(k) for the places k in order() of the items in leaves, where enters(node) is true from the root down.
template <class Enters, class Visit> void for_each_entered(const Bvh& bvh, Enters enters, Visit visit) {
    const std::vector<BvhNode>& nodes = bvh.nodes();
    std::array<std::uint32_t, Bvh::max_depth> stack;
    std::size_t size = 0;
    stack[size] = 0;
    size += !nodes.empty();
    while (size > 0) {
        const BvhNode& node = nodes[stack[--size]];
        if (!enters(node)) {
            continue;
        }
        if (!node.leaf()) {
            stack[size++] = node.first + 1;
            stack[size++] = node.first;
            continue;
        }
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
            visit(k);
        }
    }
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
    Waiting next{squared_distance(nodes[0], p), 0};
    while (true) {
        while (!(next.squared_distance < nearest())) {
            if (size == 0) {
                return;
            }
            next = stack[--size];
        }
        const BvhNode& node = nodes[next.node];
        if (node.leaf()) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                visit(k);
            }
            next.squared_distance = std::numeric_limits<double>::infinity(); // done
            continue;
        }
        Waiting other{squared_distance(nodes[node.first + 1], p), node.first + 1};
        next = {squared_distance(nodes[node.first], p), node.first};
        if (other.squared_distance < next.squared_distance) {
            std::swap(next, other);
        }
        if (other.squared_distance < nearest()) {
            stack[size++] = other;
        }
    }
}

} // namespace geometry
} // namespace foam
