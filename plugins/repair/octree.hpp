// The octree over the triangles (Huang, Su, Guibas 2018, section 3.1). Cells that contain a piece of the surface are
// split, all to the same depth. Cells without surface keep their size.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace foam::repair {

/// Coordinates of a cell of the finest level; the root spans [0, 2^depth) along each axis.
using Cell = std::array<std::int32_t, 3>;

enum class State : std::uint8_t {
    split,    ///< has eight children
    occupied, ///< touched by a triangle; of the finest level
    enclosed, ///< empty and not reached from outside
    filled,   ///< empty, and inside by its winding number
    outside,  ///< empty and reached from outside
};

struct Node {
    std::uint32_t first_child = 0;
    State state = State::enclosed;
    std::uint8_t level = 0;
    Cell place{}; ///< in cells of its level
};

class Octree {
public:
    /// Builds an octree over a mesh in the unit cube, split until at least `leaves` cells are occupied.
    Octree(const Mesh& mesh, std::size_t leaves, Context& context);

    int depth() const { return depth_; }
    double cell_size() const { return std::ldexp(1.0, -depth_); }
    std::size_t occupied() const { return offsets_.size() - 1; }
    std::vector<Node>& nodes() { return nodes_; }
    const std::vector<Node>& nodes() const { return nodes_; }

    /// Returns the leaf that contains a cell of `level`, or the node of that level itself. Precondition: inside of the
    /// root.
    std::uint32_t node_at(const Cell& place, int level) const;
    /// Returns whether the cell is solid. Everything beyond the root is outside.
    bool is_solid(const Cell& cell) const;
    /// Returns the triangles that touch the cell; none unless it is occupied.
    std::span<const std::uint32_t> triangles_at(const Cell& cell) const;
    /// Returns the lowest cell of a leaf, and its length in cells.
    Cell low_cell(const Node& node) const;
    /// Gives an empty leaf eight empty children. Returns the first.
    std::uint32_t split(std::uint32_t leaf);
    std::int32_t cells_across(const Node& node) const { return std::int32_t{1} << (depth_ - node.level); }

private:
    bool holds(const Cell& place, int level) const;

    int depth_ = 0;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> offsets_; // of the k-th occupied leaf (its first_child is k) in triangles_
    std::vector<std::uint32_t> triangles_;
};

/// Marks as filled the empty leaves that lie inside of an open `solid` (generalised winding number above one half), so
/// that flood fill through a hole does not turn the solid into a thin shell. Splits leaves that lie on both sides.
void fill_openings(Octree& octree, const Solid& solid, Context& context);

/// Marks as outside every empty leaf that is connected to the space beyond the root across faces of empty leaves.
void flood_from_outside(Octree& octree);

} // namespace foam::repair
