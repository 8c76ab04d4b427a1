#include "claim.hpp"

#include <foam/base/cancellation.hpp>

#include <cmath>
#include <limits>

namespace foam::inline search::cover {

void Deepest::clear(std::size_t count) {
    ball.assign(count, 0);
    gap.assign(count, std::numeric_limits<float>::infinity());
}

void Deepest::offer(const Points& points, std::size_t begin, std::size_t end, const Balls& balls, std::uint32_t i) {
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    const Ball b = balls[i];
    float* g = gap.data();
    std::uint32_t* o = ball.data();
    for (std::size_t p = begin; p < end; ++p) {
        const float dx = x[p] - b.x, dy = y[p] - b.y, dz = z[p] - b.z;
        const float outside = std::sqrt(dx * dx + dy * dy + dz * dz) - b.r;
        o[p] = outside < g[p] ? i : o[p];
        g[p] = outside < g[p] ? outside : g[p];
    }
}

void find_owners(const Points& points, const Balls& balls, Deepest& owners) {
    owners.clear(points.size());
    CancellationCounter often(16);
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        often.check();
        owners.offer(points, 0, points.size(), balls, i);
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

} // namespace foam::search::cover
