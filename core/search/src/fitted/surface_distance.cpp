#include "surface_distance.hpp"

#include <foam/base/cancellation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace foam::inline search::fitted {

using by_spheres::Ball;
using by_spheres::Balls;
using by_spheres::Points;

/// Sets of points that steps use in turn.
static constexpr std::size_t point_sets = 4;

/// Exponent of the power mean. A higher one is nearer to the largest distance, but then few points pull at a time.
static constexpr int power = 8;

static float to_the_seventh(float x) {
    const float square = x * x;
    return square * square * square * x;
}

namespace {

/// For each point, its distance from the nearest ball, negative inside, and that ball.
struct Nearest {
    std::vector<float> distance;
    std::vector<std::uint32_t> ball;

    Nearest(const Points& points, const Balls& balls);
    /// Returns the power mean of the distances outside.
    float high() const;
};

} // namespace

FOAM_FOR_WIDE_VECTORS
static void take_nearer(const Points& points, const Ball& ball, std::uint32_t index, float* distance,
                        std::uint32_t* nearest) {
    const float *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    const std::size_t count = points.size();
    for (std::size_t p = 0; p < count; ++p) {
        const float dx = x[p] - ball.x, dy = y[p] - ball.y, dz = z[p] - ball.z;
        const float beyond = std::sqrt(dx * dx + dy * dy + dz * dz) - ball.r;
        nearest[p] = beyond < distance[p] ? index : nearest[p];
        distance[p] = beyond < distance[p] ? beyond : distance[p];
    }
}

Nearest::Nearest(const Points& points, const Balls& balls)
    : distance(points.size(), std::numeric_limits<float>::infinity()), ball(points.size(), 0) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        take_nearer(points, balls[i], static_cast<std::uint32_t>(i), distance.data(), ball.data());
    }
}

float Nearest::high() const {
    float largest = 0;
    for (const float d : distance) {
        largest = std::max(largest, d);
    }
    if (!(largest > 0)) {
        return 0;
    }
    double sum = 0; // of shares of the largest: the power of a small distance itself underflows
    for (const float d : distance) {
        const float share = std::max(d, 0.0f) / largest;
        sum += to_the_seventh(share) * share;
    }
    return largest * static_cast<float>(std::pow(sum / static_cast<double>(distance.size()), 1.0 / power));
}

SurfaceDistance::SurfaceDistance(const Solid& solid, const by_spheres::Frame& frame, std::size_t points)
    : sets_(point_sets) {
    const std::vector<SurfacePoint> samples = solid.sample_surface(points, 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        sets_[i % point_sets].add(frame.to_unit(samples[i].point));
    }
}

double SurfaceDistance::of(const Balls& balls, const Weights& weights) const {
    double sum = 0;
    for (const Points& points : sets_) {
        check_cancelled();
        const Nearest nearest(points, balls);
        double mean = 0;
        for (const float distance : nearest.distance) {
            mean += std::max(distance, 0.0f);
        }
        mean /= static_cast<double>(std::max<std::size_t>(points.size(), 1));
        sum += weights.mean * mean + weights.high * nearest.high();
    }
    return sum / point_sets;
}

void SurfaceDistance::add_slopes(const Balls& balls, std::size_t turn, const Weights& weights,
                                 std::vector<by_spheres::Slope>& slopes) const {
    const Points& points = sets_[turn % point_sets];
    const Nearest nearest(points, balls);
    const float high = nearest.high(), count = static_cast<float>(points.size());
    const float of_mean = static_cast<float>(weights.mean) / count, of_high = static_cast<float>(weights.high) / count;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const float distance = nearest.distance[p];
        if (!(distance > 0)) {
            continue;
        }
        const float pull = of_mean + of_high * to_the_seventh(distance / high);
        const Ball& ball = balls[nearest.ball[p]];
        by_spheres::Slope& slope = slopes[nearest.ball[p]];
        const float scale = pull / (distance + ball.r);
        slope.x -= scale * (points.x[p] - ball.x);
        slope.y -= scale * (points.y[p] - ball.y);
        slope.z -= scale * (points.z[p] - ball.z);
        slope.r -= pull;
    }
}

void SurfaceDistance::add_uses(const Balls& balls, const Weights& weights, std::vector<double>& uses) const {
    const Points& points = sets_.front();
    const double share = weights.mean / static_cast<double>(std::max<std::size_t>(points.size(), 1));
    CancellationCounter asking(1024);
    for (std::size_t p = 0; p < points.size(); ++p) {
        asking.check();
        float first = std::numeric_limits<float>::infinity(), second = first;
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            const float beyond =
                std::sqrt(balls[i].squared_distance(points.x[p], points.y[p], points.z[p])) - balls[i].r;
            if (beyond < first) {
                second = std::exchange(first, beyond);
                nearest = i;
            } else {
                second = std::min(second, beyond);
            }
        }
        uses[nearest] += share * static_cast<double>(std::max(second, 0.0f) - std::max(first, 0.0f));
    }
}

SurfaceDistance::Farthest SurfaceDistance::farthest(const Balls& balls) const {
    Farthest result{{}, -std::numeric_limits<float>::infinity()};
    for (const Points& points : sets_) {
        const Nearest nearest(points, balls);
        const auto largest = std::max_element(nearest.distance.begin(), nearest.distance.end());
        if (largest != nearest.distance.end() && *largest > result.distance) {
            result = {points.at(static_cast<std::size_t>(largest - nearest.distance.begin())), *largest};
        }
    }
    return result;
}

} // namespace foam::inline search::fitted
