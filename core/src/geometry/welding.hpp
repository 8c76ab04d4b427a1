// Identical corners and shared edges of a raw mesh, in linear time.
#pragma once

#include <foam/mesh.hpp>

#include <vector>

namespace foam::geometry {

/// For every vertex the smallest index of a vertex at the same position (-0 equals 0).
std::vector<std::uint32_t> welded_indices(const Mesh& mesh);

/// A triangle's side; sides of one edge are neighbours in a sorted list.
struct Side {
    std::uint32_t low, high, triangle;
    bool forward; ///< passed from low to high

    bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

/// The sides of the triangles with use[i] != 0, by edge, then by triangle. Sides whose ends are one vertex are left
/// out.
std::vector<Side> sides_by_edge(const std::vector<Triangle>& triangles, const std::vector<char>& use,
                                std::size_t vertex_count);

/// Calls visit(begin, end) for the sides of every edge.
template <class Visit> void for_each_edge(const std::vector<Side>& sides, Visit visit) {
    for (std::size_t begin = 0; begin < sides.size();) {
        std::size_t end = begin + 1;
        while (end < sides.size() && sides[end].same_edge(sides[begin])) {
            ++end;
        }
        visit(&sides[begin], &sides[begin] + (end - begin));
        begin = end;
    }
}

/// Disjoint sets of the numbers below `count`, with path halving; the smallest member stands for its set.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t count);
    std::uint32_t find(std::uint32_t i);
    void unite(std::uint32_t a, std::uint32_t b);

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace foam::geometry
