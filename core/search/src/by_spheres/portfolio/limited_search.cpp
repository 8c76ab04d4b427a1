#include "by_spheres/portfolio/searches.hpp"

#include "by_spheres/measured/points.hpp"
#include "by_spheres/starts/starts.hpp"

#include <foam/base/cancellation.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/volumes.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace foam::inline search::by_spheres {
namespace {

std::size_t pieces_for(std::size_t count) {
    constexpr std::size_t fewest = 2000, a_ball = 60;
    return std::max(fewest, a_ball * count);
}

double cost_of(const Balls& balls, const Limits& limits) {
    constexpr double dear = 10; // times the volume of the protrusion, or more
    double over = 0;
    for (const Ball& b : balls) {
        over += 4 * std::numbers::pi * b.r * b.r * beyond(b, limits);
    }
    return exact_union_volume(unit_spheres(balls)) + dear * over;
}

double mean_radius_of(const Balls& balls) {
    double sum = 0;
    for (const Ball& b : balls) {
        sum += b.r;
    }
    return sum / static_cast<double>(balls.size());
}

} // namespace

LimitedSearch::LimitedSearch(const Solid& solid, const Frame& frame, Limits limits, std::size_t count,
                             std::uint64_t seed)
    : limits_(std::move(limits)), count_(count), seed_(seed), skin_(solid.surface(), frame, pieces_for(count)),
      some_(skin_.sample(pieces_for(count) / 5)), cells_(skin_, limits_), fine_directions_(spread_directions(256, 0)) {
    for (std::uint64_t turn = 0; turn < 4; ++turn) {
        directions_.push_back(spread_directions(64, turn));
    }
}

Balls LimitedSearch::cover(const Balls& start) {
    constexpr int first_steps = 20, steps = 100, last_fits = 6;
    constexpr double first_step = 0.05;
    Random random(derive_seed(seed_, "limited starts"));
    std::vector<Found> found;
    for (const Balls& balls : {start, divided(some_, {}, count_, limits_), clusters(some_, count_, random)}) {
        found.push_back(descended(fitted(balls), first_steps, first_step));
    }
    const auto less = [](const Found& a, const Found& b) { return a.cost < b.cost; };
    Found best = descended(*std::min_element(found.begin(), found.end(), less), steps, first_step);
    for (int i = 0; i < last_fits; ++i) {
        check_cancelled();
        Found next = fitted(best.balls);
        if (next.cost >= best.cost) {
            break;
        }
        best = std::move(next);
    }
    return best.balls;
}

LimitedSearch::Found LimitedSearch::fitted(const Balls& balls) {
    Found found{cells_.fitted(balls, fine_directions_), 0};
    found.cost = cost_of(found.balls, limits_);
    return found;
}

/// Returns the best on the way. Lengths of steps are in units of the balls' mean radius, falling geometrically.
LimitedSearch::Found LimitedSearch::descended(Found start, int steps, double first_step) {
    constexpr double last_step = 0.001;
    Found best = start;
    Balls balls = std::move(start.balls);
    for (int i = 0; i < steps; ++i) {
        check_cancelled();
        if (balls.size() < count_) { // some have no part
            balls = divided(some_, std::move(balls), count_, limits_);
        }
        const double length = first_step * std::pow(last_step / first_step, static_cast<double>(i) / steps);
        Found next = fitted(stepped(balls, length * mean_radius_of(balls),
                                    directions_[static_cast<std::size_t>(i) % directions_.size()]));
        balls = next.balls;
        if (next.cost < best.cost) {
            best = std::move(next);
        }
    }
    return best;
}

/// Returns the balls after a step along the shape derivative of the union's volume: by a radius the exposed area of the
/// ball, by a centre the integral of the normal over it. One scale for all balls.
Balls LimitedSearch::stepped(const Balls& balls, double length, const Points& directions) {
    struct Gradient {
        Vec3 center{};
        double radius = 0;
    };
    std::vector<Gradient> slopes(balls.size());
    double square = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (!exposed_.look(balls, i, directions)) {
            continue;
        }
        for (std::size_t k = 0; k < directions.size(); ++k) {
            if (exposed_.depth()[k] > 0) {
                slopes[i].center += directions.at(k);
                slopes[i].radius += 1;
            }
        }
        const double area = static_cast<double>(balls[i].r) * balls[i].r;
        slopes[i] = {slopes[i].center * area, slopes[i].radius * area};
        square += squared_norm(slopes[i].center) + slopes[i].radius * slopes[i].radius;
    }
    const double scale = square > 0 ? length / std::sqrt(square / static_cast<double>(4 * balls.size())) : 0;
    Balls moved = balls;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        constexpr double longest = 4; // step lengths
        const double size = std::sqrt((squared_norm(slopes[i].center) + slopes[i].radius * slopes[i].radius) / 4);
        const double share = size * scale > longest * length ? longest * length / size : scale;
        const Vec3 center = Vec3{balls[i].x, balls[i].y, balls[i].z} - slopes[i].center * share;
        moved[i] = ball_of({center, std::max(balls[i].r - slopes[i].radius * share, 0.1 * balls[i].r)});
    }
    return moved;
}

} // namespace foam::search::by_spheres
