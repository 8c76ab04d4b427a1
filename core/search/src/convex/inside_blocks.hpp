// The inside of a body as cubes, for what elements are to hold besides the surface.
#pragma once

#include "by_spheres/measured/occupancy.hpp"

#include <foam/geometry/vector.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace foam::inline search::convex {

/// A cube inside a body, or one with some of it, in the body's units.
struct Block {
    Vec3 center;
    double half;
    bool full;  ///< all of it is inside
    bool whole; ///< it has no parts: at least half of it is inside, but not all

    Vec3 corner(int k) const { return center + Vec3{k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? half : -half}; }
    double reach() const;
};

/// The inside of a body, as a tree of cubes. Those with less than half of their volume inside are left out: the surface
/// in them is held anyway.
class InsideBlocks {
public:
    /// O(cells of the occupancy).
    explicit InsideBlocks(const by_spheres::Occupancy& occupancy);

    /// Visits cubes from large to small: visit(block) returns whether to go on with its parts. The parts of a full one
    /// are halved without end.
    template <class Visit> void visit(Visit visit) const {
        if (!levels_.empty()) {
            descend(levels_.size() - 1, {0, 0, 0}, visit);
        }
    }

private:
    enum class State : char { empty, mixed, full };
    struct Level {
        std::array<int, 3> count{};
        double edge = 1;
        std::vector<State> states;

        State& at(const std::array<int, 3>& i) {
            return states[static_cast<std::size_t>((i[2] * count[1] + i[1]) * count[0] + i[0])];
        }
        State at(const std::array<int, 3>& i) const {
            return states[static_cast<std::size_t>((i[2] * count[1] + i[1]) * count[0] + i[0])];
        }
    };

    template <class Visit> void descend(std::size_t level, const std::array<int, 3>& i, Visit visit) const {
        const Level& here = levels_[level];
        const State state = here.at(i);
        if (state == State::empty) {
            return;
        }
        const Block block{low_ + Vec3{i[0] + 0.5, i[1] + 0.5, i[2] + 0.5} * here.edge, here.edge / 2,
                          state == State::full, state == State::mixed && level == 0};
        if (!visit(block)) {
            return;
        }
        if (level == 0) {
            if (block.full) {
                halve(block, visit);
            }
            return;
        }
        const Level& below = levels_[level - 1];
        for (int k = 0; k < 8; ++k) {
            const std::array<int, 3> part{2 * i[0] + (k & 1), 2 * i[1] + (k >> 1 & 1), 2 * i[2] + (k >> 2)};
            if (part[0] < below.count[0] && part[1] < below.count[1] && part[2] < below.count[2]) {
                descend(level - 1, part, visit);
            }
        }
    }
    template <class Visit> static void halve(const Block& block, Visit visit) {
        for (int k = 0; k < 8; ++k) {
            const Block part{(block.center + block.corner(k)) * 0.5, block.half / 2, true, false};
            if (visit(part)) {
                halve(part, visit);
            }
        }
    }

    Vec3 low_{};
    std::vector<Level> levels_; ///< the finest first
};

} // namespace foam::inline search::convex
