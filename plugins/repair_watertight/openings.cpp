#include "octree.hpp"

#include <foam/parallel.hpp>

namespace foam::watertight {
namespace {

enum class Side : char { outside, inside, both };

/// Where a leaf's corners and its middle lie.
Side side_of(const Node& node, const Solid& solid) {
    const double size = std::ldexp(1.0, -node.level);
    const Vec3 low = Vec3{double(node.place[0]), double(node.place[1]), double(node.place[2])} * size;
    const bool middle = solid.contains(low + Vec3{0.5, 0.5, 0.5} * size);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 step = Vec3{double(corner & 1), double(corner >> 1 & 1), double(corner >> 2 & 1)} * size;
        if (solid.contains(low + step) != middle) {
            return Side::both;
        }
    }
    return middle ? Side::inside : Side::outside;
}

} // namespace

void fill_openings(Octree& octree, const Solid& solid, Context& context) {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < octree.nodes().size(); ++i) {
        if (octree.nodes()[i].state == State::enclosed) {
            open.push_back(i);
        }
    }
    while (!open.empty()) {
        context.check_cancelled();
        std::vector<Side> sides(open.size());
        parallel_for(open.size(), [&](std::size_t k) { sides[k] = side_of(octree.nodes()[open[k]], solid); });
        std::vector<std::uint32_t> next;
        for (std::size_t k = 0; k < open.size(); ++k) {
            Node& node = octree.nodes()[open[k]];
            if (sides[k] == Side::both && node.level < octree.depth()) {
                const std::uint32_t first = octree.split(open[k]);
                for (std::uint32_t child = 0; child < 8; ++child) {
                    next.push_back(first + child);
                }
            } else if (sides[k] == Side::inside || (sides[k] == Side::both && solid.contains(octree.center(node)))) {
                node.state = State::filled;
            }
        }
        open = std::move(next);
    }
}

} // namespace foam::watertight
