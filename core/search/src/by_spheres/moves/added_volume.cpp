#include "by_spheres/moves/moves.hpp"

#include "by_spheres/measured/points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace foam::inline search::by_spheres {
namespace {

constexpr std::size_t cells_across = 8; ///< enough to find a cheap pair

/// A ball whose surface is blurred over the width of a cell, so that sums vary smoothly.
struct Blurred {
    Ball ball;
    float steepness, most;

    Blurred(const Ball& b, float cell)
        : ball(b), steepness(b.r > 0 ? 0.5f / (b.r * cell) : 0), most(b.r > 0 ? b.r * b.r * steepness + 0.5f : 0) {}
    /// Returns the share of a cell inside the ball, before limits to 0 and 1.
    float share(float x, float y, float z) const { return most - ball.squared_distance(x, y, z) * steepness; }
};

float limited(float share) {
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

} // namespace

FOAM_FOR_WIDE_VECTORS
double added_volume(const Ball& merged, const Ball& a, const Ball& b, const Balls& others, const Occupancy& occupancy) {
    constexpr float least_change = 1e-3f;
    Box box;
    for (const Ball& ball : {merged, a, b}) {
        const Vec3 reach{ball.r, ball.r, ball.r};
        box.add(center_of(ball) - reach);
        box.add(center_of(ball) + reach);
    }
    const Vec3 size = box.size();
    const auto cell = static_cast<float>(std::max({size.x, size.y, size.z})) / cells_across;
    if (!(cell > 0)) {
        return 0;
    }
    const Blurred whole(merged, cell), first(a, cell), second(b, cell);
    std::vector<Blurred> blurred;
    for (const Ball& other : others) {
        blurred.emplace_back(other, cell);
    }
    const auto low = [&](double least) { return static_cast<float>(least) + cell / 2; };
    double sum = 0;
    for (float z = low(box.low.z); z < box.high.z; z += cell) {
        for (float y = low(box.low.y); y < box.high.y; y += cell) {
            std::array<float, cells_across> x, change;
            for (std::size_t i = 0; i < cells_across; ++i) {
                x[i] = low(box.low.x) + static_cast<float>(i) * cell;
                const float in_first = first.share(x[i], y, z), in_second = second.share(x[i], y, z);
                change[i] = limited(whole.share(x[i], y, z)) - limited(in_first > in_second ? in_first : in_second);
            }
            for (std::size_t i = 0; i < cells_across; ++i) {
                if (std::abs(change[i]) < least_change) {
                    continue;
                }
                float free = occupancy.outside(x[i], y, z);
                for (std::size_t k = 0; k < blurred.size() && free > 0; ++k) {
                    free = std::min(free, 1 - blurred[k].share(x[i], y, z));
                }
                sum += static_cast<double>(change[i]) * std::max(free, 0.0f);
            }
        }
    }
    return sum * cell * cell * cell;
}

} // namespace foam::inline search::by_spheres
