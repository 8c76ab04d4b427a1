#include "by_spheres/portfolio/problem.hpp"

#include "by_spheres/measured/points.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace foam::inline search::by_spheres {

void Deepest::clear(std::size_t count) {
    ball.assign(count, 0);
    gap.assign(count, std::numeric_limits<float>::infinity());
}

/// Finds the least distance outside the balls, and whose it is, for the points from `begin` to `end`.
FOAM_FOR_WIDE_VECTORS
static void find_deepest(const Points& points, std::size_t begin, std::size_t end, const Balls& balls,
                         std::span<const std::uint32_t> named, float* gap, std::uint32_t* ball) {
    // Hot loop of the search: eight points at a time.
    constexpr std::size_t lanes = 8;
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    std::size_t p = begin;
    for (; p + lanes <= end; p += lanes) {
        float least[lanes];
        std::uint32_t who[lanes];
        std::copy(gap + p, gap + p + lanes, least);
        std::copy(ball + p, ball + p + lanes, who);
        for (const std::uint32_t i : named) {
            const Ball b = balls[i];
            for (std::size_t l = 0; l < lanes; ++l) {
                const float dx = x[p + l] - b.x, dy = y[p + l] - b.y, dz = z[p + l] - b.z;
                const float outside = std::sqrt(dx * dx + dy * dy + dz * dz) - b.r;
                who[l] = outside < least[l] ? i : who[l];
                least[l] = outside < least[l] ? outside : least[l];
            }
        }
        std::copy(least, least + lanes, gap + p);
        std::copy(who, who + lanes, ball + p);
    }
    for (; p < end; ++p) {
        for (const std::uint32_t i : named) {
            const Ball b = balls[i];
            const float dx = x[p] - b.x, dy = y[p] - b.y, dz = z[p] - b.z;
            const float outside = std::sqrt(dx * dx + dy * dy + dz * dz) - b.r;
            ball[p] = outside < gap[p] ? i : ball[p];
            gap[p] = outside < gap[p] ? outside : gap[p];
        }
    }
}

void Deepest::offer(const Points& points, std::size_t begin, std::size_t end, const Balls& balls,
                    std::span<const std::uint32_t> named) {
    find_deepest(points, begin, end, balls, named, gap.data(), ball.data());
}

void find_owners(const Points& points, const Balls& balls, Deepest& owners) {
    constexpr std::size_t at_once = 1024;
    owners.clear(points.size());
    std::vector<std::uint32_t> all(balls.size());
    std::iota(all.begin(), all.end(), 0u);
    for (std::size_t begin = 0; begin < points.size(); begin += at_once) {
        check_cancelled();
        owners.offer(points, begin, std::min(begin + at_once, points.size()), balls, all);
    }
}

void tighten(const Points& points, Balls& balls) {
    Deepest owners;
    std::vector<float> squared(balls.size());
    for (int round = 0; round < 3; ++round) {
        find_owners(points, balls, owners);
        std::fill(squared.begin(), squared.end(), 0.0f);
        for (std::size_t p = 0; p < points.size(); ++p) {
            float& s = squared[owners.ball[p]];
            s = std::max(s, balls[owners.ball[p]].squared_distance(points.x[p], points.y[p], points.z[p]));
        }
        for (std::size_t i = 0; i < balls.size(); ++i) {
            balls[i].r = std::sqrt(squared[i]);
        }
    }
}

} // namespace foam::search::by_spheres
