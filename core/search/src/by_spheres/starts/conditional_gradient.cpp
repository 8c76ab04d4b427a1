#include "by_spheres/starts/starts.hpp"

#include "by_spheres/measured/missing_volume.hpp"
#include "by_spheres/measured/points.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace foam::inline search::by_spheres {
namespace {

const Points& directions() {
    static const Points spread = spread_directions(256, 0);
    return spread;
}

Balls between(const Balls& from, const Balls& to, double share) {
    const auto t = static_cast<float>(share);
    Balls balls = from;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        Ball& b = balls[i];
        b = {b.x + t * (to[i].x - b.x), b.y + t * (to[i].y - b.y), b.z + t * (to[i].z - b.z),
             b.r + t * (to[i].r - b.r)};
    }
    return balls;
}

} // namespace

ConditionalGradient::ConditionalGradient(const FineSurface& skin, const Occupancy& occupancy)
    : occupancy_(occupancy), cells_(skin) {
    constexpr std::size_t most = 4000; // enough to detect a cavity
    const Points& all = occupancy.inside();
    const std::size_t stride = 1 + all.size() / most;
    for (std::size_t k = 0; k < all.size(); k += stride) {
        inside_.add(all, k);
    }
    inside_volume_ = std::pow(occupancy.cell(), 3) * static_cast<double>(all.size()) /
                     static_cast<double>(std::max<std::size_t>(1, inside_.size()));
}

CoverCandidate ConditionalGradient::improved(Balls balls, int steps) {
    constexpr double shortest = 0.01, less_than_shortest = 1.0 / 16, least_gain = 1e-4;
    constexpr int most_slow = 2;
    CoverCandidate best{std::numeric_limits<double>::infinity(), {}};
    double longest = 1, before = best.volume;
    int slow = 0;
    for (int step = 0; step < steps && longest > shortest && slow < most_slow; ++step) {
        check_cancelled();
        balls = cells_.shared(balls);
        hold_parts(balls);
        const CoverCandidate now{claim(balls), balls};
        double share = longest;
        CoverCandidate next = line_search(now, towards(balls), share);
        longest = share > 0 ? std::min(1.0, 2 * share) : longest * less_than_shortest;
        slow = next.volume > before * (1 - least_gain) ? slow + 1 : 0;
        before = std::min(before, next.volume);
        balls = next.balls;
        if (next.volume < best.volume) {
            best = std::move(next);
        }
    }
    return best;
}

CoverCandidate ConditionalGradient::line_search(const CoverCandidate& balls, const Balls& end, double& share) {
    constexpr int trials = 4;
    CoverCandidate best = balls;
    double now = share;
    share = 0;
    for (int trial = 0; trial < trials; ++trial, now /= 2) {
        Balls mixed = between(balls.balls, end, now);
        const double volume = claim(mixed);
        if (volume < best.volume) {
            best = {volume, std::move(mixed)};
            share = now;
        } else if (share > 0) {
            break;
        }
    }
    return best;
}

double ConditionalGradient::claim(const Balls& balls) {
    return exact_union_volume(unit_spheres(balls)) +
           inside_volume_ * static_cast<double>(count_missing(inside_, balls, owners_));
}

void ConditionalGradient::hold_parts(Balls& balls) const {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Points& part = cells_.parts()[i];
        const Vec3 center{balls[i].x, balls[i].y, balls[i].z};
        balls[i].r = std::sqrt(farthest(part, part.size(), center).squared);
    }
}

Balls ConditionalGradient::towards(const Balls& balls) {
    Balls ends;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Points& part = cells_.parts()[i];
        ends.push_back(enclosing_ball_.of(part, part.size(), tilt(balls, i), {balls[i].x, balls[i].y, balls[i].z}));
    }
    return ends;
}

Vec3 ConditionalGradient::tilt(const Balls& balls, std::size_t i) {
    constexpr double longest = 0.98;
    if (!exposed_.look(balls, i, directions())) {
        return {};
    }
    const Ball& ball = balls[i];
    Vec3 force{};
    double area = 0;
    for (std::size_t k = 0; k < directions().size(); ++k) {
        if (exposed_.depth()[k] > 0) {
            const Vec3 normal = directions().at(k);
            const double shows =
                occupancy_.outside(ball.x + ball.r * directions().x[k], ball.y + ball.r * directions().y[k],
                                   ball.z + ball.r * directions().z[k]);
            force += normal * shows;
            area += shows;
        }
    }
    return tilt_of(force, area, longest);
}

} // namespace foam::search::by_spheres
