// A mesh rebuilt from voxels: octree, surface, projection to the input.
#pragma once

#include "soup.hpp"

#include <foam/geometry/mesh.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace foam::repair {

// The octree over the triangles (Huang, Su, Guibas 2018, section 3.1). Cells that contain a piece of the surface are
// split, all to the same depth. Cells without surface keep their size.

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

/// Two triangles that share a diagonal: a face of a cell.
struct Quad {
    std::array<std::uint32_t, 4> corners;
    std::uint32_t first_triangle; ///< and the one after it
};

struct VoxelSurface {
    Mesh mesh;                            ///< in the octree's unit cube
    std::vector<Quad> quads;              ///< faces whose diagonal may be changed
    std::vector<std::vector<Cell>> cells; ///< of each vertex: the solid cells whose faces meet there
};

/// Returns the surface. Solid cells are joined across faces only. Where two of them touch in an edge or a corner, each
/// gets its own vertices. An edge that occurs twice gets a midpoint for each occurrence, so that no two edges have the
/// same ends.
VoxelSurface voxel_surface(const Octree& octree, Context& context);

/// The point of the input nearest to a vertex.
struct Foot {
    Vec3 point;
    double distance = std::numeric_limits<double>::infinity();
};

/// For every vertex the triangles of the input in the solid cells around it: its own cells and those joined to them
/// across faces, among the eight cells at the vertex. Triangles behind a pinch do not count.
class Nearby {
public:
    Nearby(const Mesh& input, const VoxelSurface& surface, const Octree& octree);

    bool none(std::uint32_t vertex) const { return lists_[vertex].empty(); }
    /// Returns the closest point on the triangles near `vertex`. Precondition: there are some.
    Foot closest(std::uint32_t vertex, const Vec3& p) const;
    /// Returns whether the segment passes through a triangle near `vertex`.
    bool is_crossed(std::uint32_t vertex, const Vec3& a, const Vec3& b) const;

private:
    /// A triangle and its bounding ball, to skip distant triangles.
    struct Item {
        Corners corners;
        Vec3 center;
        double radius;
    };

    void collect(std::uint32_t vertex, const VoxelSurface& surface, const Octree& octree);

    std::vector<Item> items_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

struct ProjectOptions {
    /// The distances of vertices from the surface of a solid and from a sheet without inside, in cells.
    double off_solids = 0, off_sheets = 0;
    int rounds = 10; ///< of smoothing and projection
};

/// Moves the vertices of `surface` to just outside of the input, whose inside `solid` determines. A vertex never passes
/// through a triangle of the input, so both sides of a thin sheet stay on their sides. No move inverts a triangle.
/// Returns the share of the vertices over sheets.
double project(VoxelSurface& surface, const Nearby& nearby, const Solid& solid, double cell,
               const ProjectOptions& options, Context& context);

/// Removes intersections. `mesh` is `voxels` with its vertices projected to the input. Vertices of triangles that
/// intersect move back towards their voxel positions, by halves and finally completely, until no triangles intersect:
/// the faces of voxels never do. Returns the number of vertices that moved back.
std::size_t untangle(Mesh& mesh, const Mesh& voxels, Context& context);

struct RebuildOptions {
    std::size_t leaves = 0; ///< least number of occupied cells of the octree
    bool fill_openings =
        false; ///< the inside of a mesh with holes is solid, too, not only what flood fill cannot reach
};

/// Returns a closed, outward, 2-manifold surface around the triangles of `mesh`; cavities are filled. Precondition: at
/// least one triangle with an area.
Mesh rebuilt(const Mesh& mesh, const RebuildOptions& options, Context& context);

} // namespace foam::repair
