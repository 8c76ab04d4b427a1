#include "by_spheres/descent/descent.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::by_spheres {

void QuickDescent::run(Balls& balls, const QuickDescentPlan& plan, const Refresh& refresh) {
    constexpr float reach_of_steps = 0.2f; // steps go back and forth
    Points points;
    mean_.assign(balls.size(), {});
    square_ = 0;
    mean_scale_ = square_scale_ = 1;
    StepLengths lengths(balls, plan.steps, plan.first_step, plan.last_step);
    for (int i = 0; i < plan.steps; ++i, lengths.advance()) {
        check_cancelled();
        const float length = lengths.now();
        if (i % plan.refresh == 0) {
            refresh(balls, points, reach_of_steps * length * static_cast<float>(plan.refresh));
            pressed_.assign(points.size(), 0);
        }
        find_slopes(balls, directions_[static_cast<std::size_t>(i) % directions_.size()]);
        step(balls, length);
        hold(points, balls, length);
    }
}

void QuickDescent::find_slopes(const Balls& balls, const Points& directions) {
    // Sums in several lanes, which compilers vectorise; the order is the same everywhere.
    constexpr std::size_t lanes = 4;
    slopes_.assign(balls.size(), {});
    const std::size_t count = directions.size() / lanes * lanes;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!exposed_.look(balls, i, directions)) {
            continue;
        }
        find_shows(balls[i], directions);
        const float *shows = shows_.data(), *nx = directions.x.data(), *ny = directions.y.data(),
                    *nz = directions.z.data();
        float x[lanes]{}, y[lanes]{}, z[lanes]{}, r[lanes]{};
        for (std::size_t k = 0; k < count; k += lanes) {
            for (std::size_t l = 0; l < lanes; ++l) {
                x[l] += shows[k + l] * nx[k + l];
                y[l] += shows[k + l] * ny[k + l];
                z[l] += shows[k + l] * nz[k + l];
                r[l] += shows[k + l];
            }
        }
        const float area = 4 * std::numbers::pi_v<float> * balls[i].r * balls[i].r / static_cast<float>(count);
        const auto sum = [&](const float* part) { return area * (part[0] + part[1] + part[2] + part[3]); };
        slopes_[i] = {sum(x), sum(y), sum(z), sum(r)};
    }
}

void QuickDescent::find_shows(const Ball& ball, const Points& directions) {
    const std::vector<float>& depth = exposed_.depth();
    shows_.resize(directions.size());
    for (std::size_t k = 0; k < directions.size(); ++k) {
        shows_[k] = depth[k] > 0 ? 1.0f : 0.0f;
    }
    for (std::size_t k = 0; occupancy_ && k < directions.size(); ++k) {
        if (shows_[k] > 0) {
            shows_[k] = occupancy_->outside(ball.x + ball.r * directions.x[k], ball.y + ball.r * directions.y[k],
                                            ball.z + ball.r * directions.z[k]);
        }
    }
}

void QuickDescent::step(Balls& balls, float length) {
    constexpr float mean_decay = 0.8f, square_decay = 0.95f;
    mean_scale_ *= mean_decay;
    square_scale_ *= square_decay;
    float square = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Slope& s = slopes_[i];
        Slope& m = mean_[i];
        m = {mean_decay * m.x + (1 - mean_decay) * s.x, mean_decay * m.y + (1 - mean_decay) * s.y,
             mean_decay * m.z + (1 - mean_decay) * s.z, mean_decay * m.r + (1 - mean_decay) * s.r};
        square += s.x * s.x + s.y * s.y + s.z * s.z + s.r * s.r;
    }
    square_ = square_decay * square_ + (1 - square_decay) * square / static_cast<float>(4 * balls.size());
    const float rms = std::sqrt(square_ / (1 - square_scale_));
    const float scale = rms > 0 ? -length / (1 - mean_scale_) / rms : 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        balls[i].x += scale * mean_[i].x;
        balls[i].y += scale * mean_[i].y;
        balls[i].z += scale * mean_[i].z;
        balls[i].r = std::max(balls[i].r + scale * mean_[i].r, 1e-6f);
    }
}

void QuickDescent::hold(const Points& points, Balls& balls, float slack) {
    owners_.find(points, balls);
    float largest = 0;
    for (const Ball& ball : balls) {
        largest = std::max(largest, ball.r);
    }
    // A point this deep in any ball is farther than the slack from its surface.
    const float deep = -2 * slack * largest;
    held_.clear();
    for (std::size_t p = 0; p < points.size(); ++p) {
        if (owners_.power[p] > deep) {
            held_.push_back(
                {points.x[p], points.y[p], points.z[p], 0, owners_.owner[p], static_cast<std::uint32_t>(p)});
        }
    }
    // Points active in the last step come first: most of the others are then already contained.
    std::size_t first = 0;
    for (std::size_t k = 0; k < held_.size(); ++k) {
        if (pressed_[held_[k].point]) {
            std::swap(held_[k], held_[first++]);
        }
    }
    take_in(held_, balls, pressed_);
}

} // namespace foam::search::by_spheres
