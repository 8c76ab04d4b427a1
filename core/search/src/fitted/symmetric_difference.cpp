#include "symmetric_difference.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/cell.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>

namespace foam::inline search::fitted {

using by_spheres::Ball;
using by_spheres::Balls;

/// Sets of directions that steps use in turn: one set sees what another misses.
static constexpr std::size_t turns = 4;

SymmetricDifference::SymmetricDifference(const Solid& solid, const by_spheres::Frame& frame, int resolution,
                                         std::size_t directions, const Weights& weights)
    : weights_(weights), occupancy_(solid, frame, resolution) {
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
        check_cancelled();
        directions_.push_back(by_spheres::spread_directions(directions, turn));
    }
}

double SymmetricDifference::of(const Balls& balls) const {
    const double shared = shared_with(balls);
    return weights_.excess * (exact_union_volume(by_spheres::unit_spheres(balls)) - shared) +
           weights_.missing * (volume_ - shared);
}

double SymmetricDifference::shared_with(const Balls& balls) const {
    double volume = 0;
    std::size_t last = 0; // adjacent cells often lie in the same ball
    const auto holds = [&](std::size_t i, std::size_t p) {
        return balls[i].squared_distance(cells_.x[p], cells_.y[p], cells_.z[p]) <= balls[i].r * balls[i].r;
    };
    CancellationCounter asking(1024);
    for (std::size_t p = 0; p < cells_.size(); ++p) {
        asking.check();
        for (std::size_t i = 0; i < balls.size() && !holds(last, p); ++i) {
            last = i;
        }
        volume += holds(last, p) ? volume_of_cell_[p] : 0;
    }
    return volume;
}

void SymmetricDifference::slopes(const Balls& balls, std::size_t turn, std::vector<by_spheres::Slope>& result) const {
    const by_spheres::Points& directions = directions_[turn % turns];
    const float both = static_cast<float>(weights_.excess + weights_.missing),
                missing = static_cast<float>(weights_.missing);
    result.assign(balls.size(), {});
    by_spheres::Exposed exposed;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        check_cancelled();
        if (!exposed.look(balls, i, directions)) {
            continue;
        }
        result[i] = by_spheres::slope_of(exposed, balls[i], directions, [&](float x, float y, float z) {
            return both * occupancy_.outside(x, y, z) - missing;
        });
    }
}

Balls SymmetricDifference::filled(Balls balls, std::size_t most) const {
    const by_spheres::Points& inside = occupancy_.inside();
    std::vector<float> room = occupancy_.depth();
    const auto take_away = [&](const Ball& ball) {
        for (std::size_t p = 0; p < inside.size(); ++p) {
            const float squared = ball.squared_distance(inside.x[p], inside.y[p], inside.z[p]);
            const float reach = ball.r + room[p];
            room[p] = squared < reach * reach ? std::sqrt(squared) - ball.r : room[p];
        }
    };
    std::for_each(balls.begin(), balls.end(), take_away);
    while (balls.size() < most) {
        check_cancelled();
        const auto largest = std::max_element(room.begin(), room.end());
        if (largest == room.end() || !(*largest > 0)) {
            break;
        }
        const auto p = static_cast<std::size_t>(largest - room.begin());
        balls.push_back({inside.x[p], inside.y[p], inside.z[p], *largest});
        take_away(balls.back());
    }
    return balls;
}

by_spheres::Points SymmetricDifference::some_inside(std::size_t count) const {
    const by_spheres::Points& inside = occupancy_.inside();
    const std::size_t stride = std::max<std::size_t>(1, inside.size() / count);
    by_spheres::Points result;
    for (std::size_t p = 0; p < inside.size(); p += stride) {
        result.add(inside.at(p));
    }
    return result;
}

std::vector<double> SymmetricDifference::uses(const Balls& balls) const {
    const std::vector<Sphere> spheres = by_spheres::unit_spheres(balls);
    std::vector<double> result(balls.size(), 0);
    CancellationCounter asking(1024);
    for (std::size_t p = 0; p < cells_.size(); ++p) {
        asking.check();
        std::size_t holder = balls.size(), holders = 0;
        for (std::size_t i = 0; i < balls.size() && holders < 2; ++i) {
            if (balls[i].squared_distance(cells_.x[p], cells_.y[p], cells_.z[p]) <= balls[i].r * balls[i].r) {
                holder = i;
                ++holders;
            }
        }
        if (holders == 1) {
            result[holder] += (weights_.excess + weights_.missing) * volume_of_cell_[p];
        }
    }
    for (std::size_t i = 0; i < balls.size(); ++i) {
        check_cancelled();
        result[i] -= weights_.excess * volume_saved(spheres, i, {});
    }
    return result;
}

} // namespace foam::inline search::fitted
