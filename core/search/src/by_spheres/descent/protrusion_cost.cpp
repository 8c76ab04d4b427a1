#include "by_spheres/descent/ball_cost.hpp"

#include "by_spheres/measured/points.hpp"

#include <foam/base/cancellation.hpp>

#include <cmath>
#include <limits>

namespace foam::inline search::by_spheres {

ProtrusionCost::ProtrusionCost(const DistanceField& field, std::size_t directions, int evaluations)
    : field_(field), directions_(spread_directions(directions, 0)), evaluations_(evaluations) {
    constexpr std::size_t ways = 8;
    for (std::uint64_t turn = 0; turn < 4; ++turn) {
        ways_.push_back(spread_directions(ways, turn));
    }
}

double ProtrusionCost::of(const Ball& ball) const {
    const auto distance = [&](float nx, float ny, float nz) {
        return field_.at(ball.x + ball.r * nx, ball.y + ball.r * ny, ball.z + ball.r * nz);
    };
    float most = -std::numeric_limits<float>::infinity();
    std::size_t best = 0;
    for (std::size_t k = 0; k < directions_.size(); ++k) {
        const float here = distance(directions_.x[k], directions_.y[k], directions_.z[k]);
        if (here > most) {
            most = here;
            best = k;
        }
    }
    // At its maximum the distance grows along the ball's normal: steps in that direction from the best one.
    constexpr int steps = 3;
    constexpr float ahead = 0.02f;
    Vec3 n = directions_.at(best);
    for (int i = 0; i < steps; ++i) {
        check_cancelled();
        const auto x = static_cast<float>(ball.x + ball.r * n.x), y = static_cast<float>(ball.y + ball.r * n.y),
                   z = static_cast<float>(ball.z + ball.r * n.z);
        const Vec3 slope{field_.at(x + ahead, y, z) - field_.at(x - ahead, y, z),
                         field_.at(x, y + ahead, z) - field_.at(x, y - ahead, z),
                         field_.at(x, y, z + ahead) - field_.at(x, y, z - ahead)};
        n = normalized(n + slope / (2 * ahead));
        const float here = distance(static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z));
        if (!(here > most)) {
            break;
        }
        most = here;
    }
    return most;
}

/// Steps in all directions; the step length is halved when none improves. The cost has kinks, where gradients mislead.
Ball ProtrusionCost::holding(const Points& points, const Ball& enclosing, const Ball& before) const {
    const auto at = [&](const Vec3& center) {
        return ball_of({center, std::sqrt(static_cast<double>(farthest(points, points.size(), center).squared))});
    };
    Ball best = enclosing;
    double least = of(best);
    const auto take = [&](const Ball& other) {
        const double cost = of(other);
        if (!(cost < least)) {
            return false;
        }
        best = other;
        least = cost;
        return true;
    };
    take(at({before.x, before.y, before.z}));
    double step = 0.25 * best.r;
    std::size_t turn = 0;
    for (int left = evaluations_; left > 0; ++turn) {
        check_cancelled();
        const Points& ways = ways_[turn % ways_.size()];
        bool moved = false;
        for (std::size_t k = 0; k < ways.size(); ++k, --left) {
            moved = take(at(Vec3{best.x, best.y, best.z} + ways.at(k) * step)) || moved;
        }
        step = moved ? step : step / 2;
    }
    return best;
}

} // namespace foam::search::by_spheres
