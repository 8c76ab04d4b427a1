#include "inside_blocks.hpp"

#include <algorithm>
#include <cmath>

namespace foam::inline search::convex {

double Block::reach() const {
    return std::sqrt(3.0) * half;
}

InsideBlocks::InsideBlocks(const by_spheres::Occupancy& occupancy) {
    constexpr double units = 2; // of the occupancy in one of the body
    const by_spheres::Points& inside = occupancy.inside();
    if (inside.size() == 0) {
        return;
    }
    Box box;
    for (std::size_t i = 0; i < inside.size(); ++i) {
        box.add(inside.at(i) / units);
    }
    Level finest;
    finest.edge = occupancy.cell() / units;
    low_ = box.low - Vec3{1, 1, 1} * (finest.edge / 2);
    for (int axis = 0; axis < 3; ++axis) {
        finest.count[static_cast<std::size_t>(axis)] =
            static_cast<int>(std::lround((box.high[axis] - box.low[axis]) / finest.edge)) + 1;
    }
    finest.states.assign(static_cast<std::size_t>(finest.count[0]) * static_cast<std::size_t>(finest.count[1]) *
                             static_cast<std::size_t>(finest.count[2]),
                         State::empty);
    for (std::size_t i = 0; i < inside.size(); ++i) {
        const Vec3 p = inside.at(i);
        const Vec3 at = (p / units - low_) / finest.edge;
        const bool full =
            occupancy.outside(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)) <= 0;
        finest.at({static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z)}) =
            full ? State::full : State::mixed;
    }
    levels_.push_back(std::move(finest));
    while (*std::max_element(levels_.back().count.begin(), levels_.back().count.end()) > 1) {
        const Level& fine = levels_.back();
        Level coarse;
        coarse.edge = 2 * fine.edge;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            coarse.count[axis] = (fine.count[axis] + 1) / 2;
        }
        std::array<int, 3> i{};
        for (i[2] = 0; i[2] < coarse.count[2]; ++i[2]) {
            for (i[1] = 0; i[1] < coarse.count[1]; ++i[1]) {
                for (i[0] = 0; i[0] < coarse.count[0]; ++i[0]) {
                    int full = 0, empty = 0;
                    for (int k = 0; k < 8; ++k) {
                        const std::array<int, 3> part{2 * i[0] + (k & 1), 2 * i[1] + (k >> 1 & 1), 2 * i[2] + (k >> 2)};
                        const bool beyond =
                            part[0] >= fine.count[0] || part[1] >= fine.count[1] || part[2] >= fine.count[2];
                        const State state = beyond ? State::empty : fine.at(part);
                        full += state == State::full;
                        empty += state == State::empty;
                    }
                    coarse.states.push_back(full == 8 ? State::full : empty == 8 ? State::empty : State::mixed);
                }
            }
        }
        levels_.push_back(std::move(coarse));
    }
}

} // namespace foam::inline search::convex
