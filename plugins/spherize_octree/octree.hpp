// An octree of a solid with a ball around the content of each cell.
#pragma once

#include <foam/geometry/cell.hpp>
#include <foam/sdk/context.hpp>

#include <array>
#include <optional>
#include <vector>

namespace foam::spherize_octree {

using Axes = std::array<Vec3, 3>;

/// Grown by splitting leaves; every set of leaves covers the solid.
class Octree {
public:
    /// Position of the solid in the cube along its shorter sides.
    enum class Place { middle, corner };
    /// Makes one cell: the smallest cube along the axes that contains the solid.
    Octree(const Solid& solid, const Axes& axes, Place place, Cell::Content content);

    /// Splits every leaf, `levels` times.
    void split_all(int levels, Context& context);
    /// Splits leaves, always the one that saves most of the union's volume per sphere, as long as there are at most
    /// `most` of them and volume is saved.
    void split_best(std::size_t most, Context& context);

    std::vector<Sphere> leaf_balls() const;
    std::vector<const Cell*> leaf_cells() const;
    /// Returns a level for each depth; leaves that end earlier stay in all levels below.
    SphereTree tree() const;

private:
    struct Node {
        Cell cell;
        Sphere ball;
        int depth = 0;                          ///< halvings of the cube
        std::vector<std::size_t> children;      ///< indices into nodes_; empty for a leaf
        std::optional<std::vector<Node>> parts; ///< the nodes that it would split into, once known
        std::optional<double> saved; ///< m³ of the union that splitting saves, valid while its surroundings stay
    };

    static std::vector<Node> parts_of(const Node& node);
    void split(std::size_t node);
    std::vector<std::size_t> leaves() const;
    std::optional<std::size_t> best_leaf(std::size_t room);
    void forget_around(const Sphere& changed);

    std::vector<Node> nodes_;
};

} // namespace foam::spherize_octree
