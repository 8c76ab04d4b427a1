#include "by_spheres/moves/remainder.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/starts/enclosing_ball.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::by_spheres {
namespace {

/// Returns half a step over a cell's width at the surface of the ball: |x - c|² - r² is about 2 r times the distance.
float steepness(const Ball& ball, float cell) {
    return ball.r > 0 ? 0.5f / (ball.r * cell) : 0;
}

} // namespace

void OutsideVolume::look(const Balls& others, const Ball& region) {
    constexpr float margin = 1.2f;
    region_ = region;
    region_.r *= margin;
    cell_ = 2 * region_.r / static_cast<float>(cells_);
    points_.clear();
    weight_.clear();
    const float low = -region_.r + cell_ / 2;
    for (int k = 0; k < cells_; ++k) {
        check_cancelled();
        const float dz = low + static_cast<float>(k) * cell_;
        for (int j = 0; j < cells_; ++j) {
            const float dy = low + static_cast<float>(j) * cell_;
            const float rest = region_.r * region_.r - dy * dy - dz * dz;
            if (rest <= 0) {
                continue;
            }
            look_along_row(region_.x + low, region_.y + dy, region_.z + dz, others);
            for (int i = 0; i < cells_; ++i) {
                const float dx = low + static_cast<float>(i) * cell_, free = row_[static_cast<std::size_t>(i)];
                if (free > 0 && dx * dx < rest) {
                    const Vec3 p{region_.x + dx, region_.y + dy, region_.z + dz};
                    const float weight = free * occupancy_.outside(static_cast<float>(p.x), static_cast<float>(p.y),
                                                                   static_cast<float>(p.z));
                    if (weight > 0) {
                        points_.add(p);
                        weight_.push_back(weight);
                    }
                }
            }
        }
    }
}

/// Computes the shares of a row of places outside the others.
void OutsideVolume::look_along_row(float x, float y, float z, const Balls& others) {
    row_.assign(static_cast<std::size_t>(cells_), 1.0f);
    for (const Ball& ball : others) {
        const float across = (y - ball.y) * (y - ball.y) + (z - ball.z) * (z - ball.z) - ball.r * ball.r;
        if (across > ball.r * cell_) {
            continue;
        }
        const float scale = steepness(ball, cell_);
        for (int i = 0; i < cells_; ++i) {
            float& free = row_[static_cast<std::size_t>(i)];
            const float dx = x + static_cast<float>(i) * cell_ - ball.x;
            free = std::min(free, (dx * dx + across) * scale + 0.5f);
        }
    }
}

FOAM_FOR_WIDE_VECTORS
double OutsideVolume::of(std::span<const Ball> balls) const {
    constexpr std::size_t lanes = 8;
    const Ball a = balls.front(), b = balls.back();
    const float a_scale = steepness(a, cell_), b_scale = steepness(b, cell_);
    const float a_most = a.r > 0 ? a.r * a.r * a_scale + 0.5f : 0, b_most = b.r > 0 ? b.r * b.r * b_scale + 0.5f : 0;
    const float *x = points_.x.data(), *y = points_.y.data(), *z = points_.z.data(), *weight = weight_.data();
    const auto held = [&](std::size_t i) {
        const float in_a = a_most - a.squared_distance(x[i], y[i], z[i]) * a_scale;
        const float in_b = b_most - b.squared_distance(x[i], y[i], z[i]) * b_scale;
        float share = in_a > in_b ? in_a : in_b;
        share = share < 0 ? 0 : share;
        share = share > 1 ? 1 : share;
        return share * weight[i];
    };
    float sums[lanes]{};
    const std::size_t whole = weight_.size() / lanes * lanes;
    for (std::size_t i = 0; i < whole; i += lanes) {
        for (std::size_t l = 0; l < lanes; ++l) {
            sums[l] += held(i + l);
        }
    }
    double sum = 0;
    for (const float lane : sums) {
        sum += lane;
    }
    for (std::size_t i = whole; i < weight_.size(); ++i) {
        sum += held(i);
    }
    double beyond = 0;
    for (const Ball& ball : balls) {
        const double over = std::sqrt(squared_distance(ball, region_)) + ball.r - region_.r;
        beyond += ball.r > 0 ? 4 * std::numbers::pi * ball.r * ball.r * std::max(0.0, over) : 0;
    }
    return sum * cell_ * cell_ * cell_ + beyond;
}

Vec3 OutsideVolume::tilt(std::span<const Ball> balls, std::size_t i) const {
    constexpr double longest = 0.5;
    const Ball ball = balls[i];
    const Ball* other = balls.size() > 1 && balls[1 - i].r > 0 ? &balls[1 - i] : nullptr;
    Vec3 force{};
    double area = 0;
    for (std::size_t k = 0; k < weight_.size(); ++k) {
        const float dx = points_.x[k] - ball.x, dy = points_.y[k] - ball.y, dz = points_.z[k] - ball.z;
        const float squared = dx * dx + dy * dy + dz * dz;
        if (!(squared > 0) || std::abs(squared - ball.r * ball.r) > ball.r * cell_) {
            continue; // not within half a cell of the surface
        }
        float free = 1;
        if (other) {
            const float power = other->squared_distance(points_.x[k], points_.y[k], points_.z[k]) - other->r * other->r;
            free = std::clamp(power * steepness(*other, cell_) + 0.5f, 0.0f, 1.0f);
        }
        area += weight_[k] * free;
        force += Vec3{dx, dy, dz} * (weight_[k] * free / std::sqrt(squared));
    }
    return tilt_of(force, area, longest);
}

} // namespace foam::search::by_spheres
