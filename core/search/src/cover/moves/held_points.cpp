#include "cover/moves/held_points.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace foam::inline search::cover {

static inline void press(Held& h, Ball& ball) {
    const float dx = h.x - ball.x, dy = h.y - ball.y, dz = h.z - ball.z;
    const float squared = dx * dx + dy * dy + dz * dz;
    if (h.force == 0 && squared <= ball.r * ball.r) {
        return;
    }
    const float distance = std::sqrt(squared);
    const float change = std::max((distance - ball.r) / 2, -h.force);
    h.force += change;
    const float share = distance > 0 ? change / distance : 0;
    ball.x += share * dx;
    ball.y += share * dy;
    ball.z += share * dz;
    ball.r += change;
}

void take_in(std::vector<Held>& held, Balls& balls, std::vector<char>& pressed) {
    constexpr int sweeps = 8; // after the first one
    for (Held& h : held) {
        press(h, balls[h.owner]);
    }
    std::size_t pressing = held.size();
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        check_cancelled();
        std::size_t left = 0;
        for (std::size_t k = 0; k < pressing; ++k) {
            if (held[k].force > 0) {
                press(held[k], balls[held[k].owner]);
                if (k != left) {
                    std::swap(held[k], held[left]);
                }
                ++left;
            }
        }
        pressing = left;
    }
    for (std::size_t k = pressing; k < held.size(); ++k) {
        press(held[k], balls[held[k].owner]);
    }
    for (const Held& h : held) {
        pressed[h.point] = h.force > 0;
    }
}

} // namespace foam::search::cover
