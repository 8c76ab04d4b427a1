#include "octree.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/parallel.hpp>

#include <algorithm>

namespace foam::spherize_octree {
namespace {

constexpr int deepest = 20; // halvings; a millionth of the solid's size

Cell cube_around(const Solid& solid, const Axes& axes, Octree::Place place, Cell::Content content) {
    const Cell whole = Cell::whole(solid, axes, content);
    const Vec3 size = whole.box().size();
    const double edge = std::max({size.x, size.y, size.z});
    const Vec3 cube{edge, edge, edge};
    const Vec3 low = place == Octree::Place::corner ? whole.box().low : whole.box().center() - cube * 0.5;
    return whole.in_box({low, low + cube});
}

} // namespace

Octree::Octree(const Solid& solid, const Axes& axes, Place place, Cell::Content content) {
    const Cell root = cube_around(solid, axes, place, content);
    nodes_.push_back({root, root.ball(), 0, {}, {}, {}});
}

/// Returns the octants that are not empty; if there is only one, its octants, and so on.
std::vector<Octree::Node> Octree::parts_of(const Node& node) {
    std::vector<Cell> cells{node.cell};
    int depth = node.depth;
    while (cells.size() == 1 && depth < deepest) {
        check_cancelled();
        cells = cells.front().divided({2, 2, 2});
        ++depth;
    }
    std::vector<Node> parts;
    if (cells.size() > 1) {
        for (Cell& cell : cells) {
            const Sphere ball = cell.ball();
            parts.push_back({std::move(cell), ball, depth, {}, {}, {}});
        }
    }
    return parts;
}

std::vector<std::size_t> Octree::leaves() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].children.empty()) {
            indices.push_back(i);
        }
    }
    return indices;
}

std::vector<Sphere> Octree::leaf_balls() const {
    std::vector<Sphere> balls;
    for (const std::size_t leaf : leaves()) {
        balls.push_back(nodes_[leaf].ball);
    }
    return balls;
}

std::vector<const Cell*> Octree::leaf_cells() const {
    std::vector<const Cell*> cells;
    for (const std::size_t leaf : leaves()) {
        cells.push_back(&nodes_[leaf].cell);
    }
    return cells;
}

void Octree::split(std::size_t node) {
    std::vector<Node> parts = nodes_[node].parts ? std::move(*nodes_[node].parts) : parts_of(nodes_[node]);
    nodes_[node].parts.reset();
    for (Node& part : parts) {
        nodes_[node].children.push_back(nodes_.size());
        nodes_.push_back(std::move(part));
    }
}

void Octree::split_all(int levels, Context& context) {
    for (int level = 0; level < levels; ++level) {
        const std::vector<std::size_t> all = leaves();
        parallel_for(all.size(), [&](std::size_t i) {
            context.check_cancelled();
            nodes_[all[i]].parts = parts_of(nodes_[all[i]]);
        });
        for (const std::size_t leaf : all) {
            split(leaf);
        }
    }
}

/// Returns the leaf that saves most volume per additional sphere, among those that add at most `room`.
std::optional<std::size_t> Octree::best_leaf(std::size_t room) {
    const std::vector<std::size_t> all = leaves();
    const std::vector<Sphere> balls = leaf_balls();
    parallel_for(all.size(), [&](std::size_t i) {
        Node& node = nodes_[all[i]];
        if (!node.parts) {
            node.parts = parts_of(node);
        }
        if (!node.saved) {
            std::vector<Sphere> pieces;
            for (const Node& part : *node.parts) {
                pieces.push_back(part.ball);
            }
            node.saved = pieces.empty() ? 0 : volume_saved(balls, i, pieces);
        }
    });
    std::optional<std::size_t> best;
    double most = 0;
    for (const std::size_t leaf : all) {
        const std::size_t pieces = nodes_[leaf].parts->size();
        if (pieces < 2 || pieces - 1 > room) {
            continue;
        }
        const double gain = *nodes_[leaf].saved / static_cast<double>(pieces - 1);
        if (gain > most) {
            most = gain;
            best = leaf;
        }
    }
    return best;
}

/// Forgets the savings near a changed ball: they depend on the neighbouring balls.
void Octree::forget_around(const Sphere& changed) {
    for (Node& node : nodes_) {
        if (!node.saved) {
            continue;
        }
        double reach = node.ball.radius;
        for (const Node& part : *node.parts) {
            reach = std::max(reach, distance(part.ball.center, node.ball.center) + part.ball.radius);
        }
        if (distance(node.ball.center, changed.center) < reach + changed.radius) {
            node.saved.reset();
        }
    }
}

void Octree::split_best(std::size_t most, Context& context) {
    std::size_t count = leaves().size();
    while (count < most) {
        context.check_cancelled();
        context.progress(static_cast<double>(count) / static_cast<double>(most));
        const auto leaf = best_leaf(most - count);
        if (!leaf) {
            return;
        }
        std::vector<Sphere> changed{nodes_[*leaf].ball};
        for (const Node& part : *nodes_[*leaf].parts) {
            changed.push_back(part.ball);
        }
        count += changed.size() - 2;
        nodes_[*leaf].saved.reset();
        split(*leaf);
        for (const Sphere& ball : changed) {
            forget_around(ball);
        }
    }
}

SphereTree Octree::tree() const {
    SphereTree tree;
    tree.levels.push_back({{nodes_[0].ball}, {}});
    std::vector<std::size_t> level{0};
    for (bool finer = true; finer;) {
        check_cancelled();
        std::vector<std::size_t> next;
        SphereTree::Level spheres;
        finer = false;
        for (std::size_t i = 0; i < level.size(); ++i) {
            const std::vector<std::size_t>& children = nodes_[level[i]].children;
            finer |= !children.empty();
            for (const std::size_t node : children.empty() ? std::vector<std::size_t>{level[i]} : children) {
                next.push_back(node);
                spheres.elements.spheres().push_back(nodes_[node].ball);
                spheres.parents.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (finer || tree.levels.size() == 1) { // at least two levels, as flat_tree() has them
            tree.levels.push_back(std::move(spheres));
        }
        level = std::move(next);
    }
    return tree;
}

} // namespace foam::spherize_octree
