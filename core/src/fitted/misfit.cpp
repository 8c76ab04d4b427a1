#include "fitted/misfit.hpp"

#include "cover/exposed.hpp"

#include <foam/union_volume.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::fitted {

using cover::Ball;
using cover::Balls;

/// Sets of directions that steps take in turn: what one overlooks the next one sees.
static constexpr std::size_t turns = 4;

Misfit::Misfit(const Solid& solid, const cover::Frame& frame, int resolution, std::size_t directions)
    : occupancy_(solid, frame, resolution) {
    const Vec3 half = solid.bounds().size() / frame.unit / 2;
    const double cell = occupancy_.cell();
    for (double x = -half.x - cell / 2; x < half.x + cell; x += cell) {
        for (double y = -half.y - cell / 2; y < half.y + cell; y += cell) {
            for (double z = -half.z - cell / 2; z < half.z + cell; z += cell) {
                const float outside =
                    occupancy_.outside(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                if (outside < 1) {
                    cells_.add({x, y, z});
                    volume_of_cell_.push_back((1 - outside) * static_cast<float>(cell * cell * cell));
                    volume_ += volume_of_cell_.back();
                }
            }
        }
    }
    for (std::size_t turn = 0; turn < turns; ++turn) {
        directions_.push_back(cover::spread_directions(directions, turn));
    }
}

double Misfit::of(const Balls& balls) const {
    std::vector<Sphere> spheres;
    for (const Ball& ball : balls) {
        spheres.push_back({{ball.x, ball.y, ball.z}, ball.r});
    }
    return exact_union_volume(spheres) + volume_ - 2 * shared_with(balls);
}

double Misfit::shared_with(const Balls& balls) const {
    double volume = 0;
    std::size_t last = 0; // neighbouring cells often lie in the same ball
    const auto holds = [&](std::size_t i, std::size_t p) {
        return balls[i].squared_distance(cells_.x[p], cells_.y[p], cells_.z[p]) <= balls[i].r * balls[i].r;
    };
    for (std::size_t p = 0; p < cells_.size(); ++p) {
        for (std::size_t i = 0; i < balls.size() && !holds(last, p); ++i) {
            last = i;
        }
        volume += holds(last, p) ? volume_of_cell_[p] : 0;
    }
    return volume;
}

void Misfit::slopes(const Balls& balls, std::size_t turn, std::vector<Slope>& result) const {
    const cover::Points& directions = directions_[turn % turns];
    result.assign(balls.size(), {});
    cover::Exposed exposed;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!exposed.look(balls, i, directions)) {
            continue;
        }
        const Ball ball = balls[i];
        Slope sum;
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (exposed.depth()[k] > 0) {
                const float nx = directions.x[k], ny = directions.y[k], nz = directions.z[k];
                const float w =
                    2 * occupancy_.outside(ball.x + ball.r * nx, ball.y + ball.r * ny, ball.z + ball.r * nz) - 1;
                sum.x += w * nx;
                sum.y += w * ny;
                sum.z += w * nz;
                sum.r += w;
            }
        }
        const float area = 4 * std::numbers::pi_v<float> * ball.r * ball.r / static_cast<float>(directions.size());
        result[i] = {area * sum.x, area * sum.y, area * sum.z, area * sum.r};
    }
}

Ball Misfit::largest_pocket(const Balls& balls) const {
    const cover::Points& inside = occupancy_.inside();
    Ball best;
    for (std::size_t p = 0; p < inside.size(); ++p) {
        float room = occupancy_.depth()[p];
        for (std::size_t i = 0; i < balls.size() && room > best.r; ++i) {
            const float squared = balls[i].squared_distance(inside.x[p], inside.y[p], inside.z[p]);
            const float reach = balls[i].r + room;
            room = squared < reach * reach ? std::sqrt(squared) - balls[i].r : room;
        }
        if (room > best.r) {
            best = {inside.x[p], inside.y[p], inside.z[p], room};
        }
    }
    return best;
}

} // namespace foam::fitted
