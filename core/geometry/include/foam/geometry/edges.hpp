// The sides of triangles that share an edge.
#pragma once

#include <foam/base/cancellation.hpp>
#include <foam/geometry/mesh.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

/// Side `number` % 3 of triangle `number` / 3: from that corner to the next.
struct Side {
    std::uint32_t low = 0, high = 0; ///< its ends in ascending order: equal for the sides of one edge
    std::uint32_t number = 0;
    bool forward = false; ///< runs from low to high

    std::uint32_t triangle() const { return number / 3; }
    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// Returns the sides of the triangles, sorted by edge, then by number. Sides whose ends are one vertex are left out.
/// `use`, unless empty, marks the triangles to include. O(n) as long as few triangles meet at a vertex.
/// Precondition: corners below `vertex_count`.
std::vector<Side> sides_by_edge(std::span<const Triangle> triangles, std::size_t vertex_count,
                                std::span<const char> use = {});

/// Calls visit(sides) with the sides of every edge, a std::span<const Side>. Asks on the way whether to go on.
template <class Visit> void for_each_edge(std::span<const Side> by_edge, Visit visit) {
    CancellationCounter asking(1 << 16);
    for (std::size_t begin = 0; begin < by_edge.size();) {
        asking.check();
        std::size_t end = begin + 1;
        while (end < by_edge.size() && by_edge[end].same_edge(by_edge[begin])) {
            ++end;
        }
        visit(by_edge.subspan(begin, end - begin));
        begin = end;
    }
}

} // namespace geometry
} // namespace foam
