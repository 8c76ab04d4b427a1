#include "cover/claim.hpp"

#include "cover/exposed.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace foam::cover {

double claimed_volume(const Balls& balls, const Points& directions) {
    Exposed exposed;
    double volume = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!exposed.look(balls, i, directions)) {
            continue;
        }
        const Ball& ball = balls[i];
        double sum = 0;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (exposed.depth()[k] > 0) {
                sum += ball.x * directions.x[k] + ball.y * directions.y[k] + ball.z * directions.z[k] + ball.r;
            }
        }
        volume += static_cast<double>(ball.r) * ball.r * sum;
    }
    return volume * 4 * std::numbers::pi / (3 * static_cast<double>(directions.size()));
}

void find_owners(const Points& points, const Balls& balls, std::vector<std::uint32_t>& owner, std::vector<float>& gap) {
    owner.assign(points.size(), 0);
    gap.assign(points.size(), std::numeric_limits<float>::infinity());
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
        const Ball ball = balls[i];
        float* l = gap.data();
        std::uint32_t* o = owner.data();
        for (std::size_t p = 0; p < points.size(); ++p) {
            const float dx = x[p] - ball.x, dy = y[p] - ball.y, dz = z[p] - ball.z;
            const float outside = std::sqrt(dx * dx + dy * dy + dz * dz) - ball.r;
            o[p] = outside < l[p] ? i : o[p];
            l[p] = outside < l[p] ? outside : l[p];
        }
    }
}

void tighten(const Points& points, Balls& balls) {
    std::vector<std::uint32_t> owner;
    std::vector<float> gap, squared(balls.size());
    for (int round = 0; round < 3; ++round) {
        find_owners(points, balls, owner, gap);
        std::fill(squared.begin(), squared.end(), 0.0f);
        for (std::size_t p = 0; p < points.size(); ++p) {
            float& s = squared[owner[p]];
            s = std::max(s, balls[owner[p]].squared_distance(points.x[p], points.y[p], points.z[p]));
        }
        for (std::size_t i = 0; i < balls.size(); ++i) {
            balls[i].r = std::sqrt(squared[i]);
        }
    }
}

} // namespace foam::cover
