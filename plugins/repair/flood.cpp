#include "octree.hpp"

#include <foam/base/cancellation.hpp>

namespace foam::repair {
namespace {

class Flood {
public:
    explicit Flood(Octree& octree) : octree_(octree) {}

    void run() {
        const std::vector<Node>& nodes = octree_.nodes();
        for (std::uint32_t i = 0; i < nodes.size(); ++i) {
            const std::int32_t last = (std::int32_t{1} << nodes[i].level) - 1;
            const Cell& place = nodes[i].place;
            if (std::any_of(place.begin(), place.end(), [&](std::int32_t c) { return c == 0 || c == last; })) {
                reach(i);
            }
        }
        CancellationCounter asking(4096);
        while (!open_.empty()) {
            asking.check();
            const std::uint32_t i = open_.back();
            open_.pop_back();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                spread(nodes[i], axis, -1);
                spread(nodes[i], axis, 1);
            }
        }
    }

private:
    void reach(std::uint32_t i) {
        if (octree_.nodes()[i].state == State::enclosed) {
            octree_.nodes()[i].state = State::outside;
            open_.push_back(i);
        }
    }

    /// Spreads to the leaves across one face.
    void spread(const Node& node, std::size_t axis, int direction) {
        Cell place = node.place;
        place[axis] += direction;
        if (place[axis] >= 0 && place[axis] < (std::int32_t{1} << node.level)) {
            reach_leaves(octree_.node_at(place, node.level), axis, direction);
        }
    }

    /// Reaches the leaves of a node at the face of entry.
    void reach_leaves(std::uint32_t i, std::size_t axis, int direction) {
        const Node& node = octree_.nodes()[i];
        if (node.state != State::split) {
            reach(i);
            return;
        }
        for (std::uint32_t child = 0; child < 8; ++child) {
            const bool high_half = (child >> axis & 1u) != 0;
            if (high_half != (direction > 0)) {
                reach_leaves(node.first_child + child, axis, direction);
            }
        }
    }

    Octree& octree_;
    std::vector<std::uint32_t> open_;
};

} // namespace

void flood_from_outside(Octree& octree) {
    Flood(octree).run();
}

} // namespace foam::repair
