#include "optimise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::medial {
namespace {

double distance_to_nearest(std::span<const Vec3> points, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& q : points) {
        least = std::min(least, squared_norm(q - p));
    }
    return std::sqrt(least);
}

std::size_t held(std::span<const Vec3> points, const Sphere& ball) {
    const double square = ball.radius * ball.radius;
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(), [&](const Vec3& p) { return squared_norm(p - ball.center) <= square; }));
}

/// Returns the numbers of nearly cubic cells in a box, about `count` in all; one along a side shorter than their edge.
std::array<int, 3> cubes(const Vec3& size, std::size_t count) {
    std::array<int, 3> counts{1, 1, 1};
    const double longest = std::max({size.x, size.y, size.z});
    for (double edge = longest;
         longest > 0 && static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
                                static_cast<std::size_t>(counts[2]) <
                            count;
         edge *= 0.95) {
        for (int axis = 0; axis < 3; ++axis) {
            counts[static_cast<std::size_t>(axis)] = std::max(1, static_cast<int>(std::lround(size[axis] / edge)));
        }
    }
    return counts;
}

constexpr double nearly = 1e-6; ///< units of the shape's extent

} // namespace

std::vector<Sphere> grid_seeds(std::span<const Vec3> points, const Columns& columns, std::size_t count) {
    Box box;
    for (const Vec3& p : points) {
        box.add(p);
    }
    const Vec3 size = box.size();
    const std::array<int, 3> counts = cubes(size, count);
    std::vector<Sphere> seeds;
    for (int x = 0; x < counts[0]; ++x) {
        for (int y = 0; y < counts[1]; ++y) {
            for (int z = 0; z < counts[2]; ++z) {
                const Vec3 p = box.low + Vec3{size.x * (x + 0.5) / counts[0], size.y * (y + 0.5) / counts[1],
                                              size.z * (z + 0.5) / counts[2]};
                if (columns.inside(p)) {
                    seeds.push_back({p, distance_to_nearest(points, p)});
                }
            }
        }
    }
    const std::size_t step = std::max<std::size_t>(1, 5 * points.size() / count);
    for (std::size_t i = 0; i < points.size(); i += step) {
        seeds.push_back({points[i], 0});
    }
    return seeds;
}

std::vector<Sphere> touching_seeds(std::span<const Sphere> seeds, std::span<const Vec3> points) {
    std::vector<Sphere> result;
    for (const Sphere& seed : seeds) {
        if (distance_to_nearest(points, seed.center) <= seed.radius + nearly) {
            result.push_back(seed);
        }
    }
    if (result.empty() && !points.empty()) {
        result.push_back({points[0], 0});
    }
    return result;
}

Spawn::Spawn(std::span<const Vec3> points, std::span<const Sphere> seeds, const Columns& columns, std::size_t most)
    : points_(points.begin(), points.end()), seeds_(seeds.begin(), seeds.end()), columns_(columns), most_(most),
      greatest_(std::numeric_limits<double>::infinity()) {
    for (const Sphere& seed : seeds_) {
        double farthest = 0;
        for (const Vec3& p : points_) {
            farthest = std::max(farthest, distance(p, seed.center));
        }
        greatest_ = std::min(greatest_, farthest - seed.radius);
    }
}

/// Returns the distance to the nearest point, negative outside the solid.
double Spawn::depth(const Vec3& p) const {
    const double distance = distance_to_nearest(points_, p);
    return columns_.inside(p) ? distance : -distance;
}

/// Returns the ball with most of the open points, by pattern search for its centre (Hooke and Jeeves 1961); of two with
/// as many, the first.
Sphere Spawn::moved(const Sphere& start, double stand_off, std::span<const Vec3> open) const {
    Sphere best = start;
    std::size_t most = held(open, start);
    for (double step = start.radius / 2; step > start.radius / 20; step /= 2) {
        for (bool better = true; better;) {
            better = false;
            const Sphere from = best;
            for (int axis = 0; axis < 3; ++axis) {
                for (const double side : {-step, step}) {
                    Sphere next = from;
                    next.center[axis] += side;
                    next.radius = depth(next.center) + stand_off;
                    const std::size_t count = next.radius > 0 ? held(open, next) : 0;
                    if (count > most) {
                        most = count;
                        best = next;
                        better = true;
                    }
                }
            }
        }
    }
    return best;
}

/// Returns balls that contain all points; empty if some points are out of reach of all seeds, or it takes too many
/// balls.
std::vector<Sphere> Spawn::placed(double stand_off, Context& context) const {
    std::vector<Vec3> open = points_;
    std::vector<Sphere> balls;
    // The number of open points in a seed only falls: an old value is an upper bound (lazy greedy, Minoux 1978).
    std::vector<std::size_t> bound(seeds_.size(), points_.size());
    while (!open.empty()) {
        context.check_cancelled();
        std::size_t most = 0;
        Sphere best;
        for (std::size_t i = 0; i < seeds_.size(); ++i) {
            if (bound[i] <= most) {
                continue;
            }
            const Sphere ball{seeds_[i].center, seeds_[i].radius + stand_off};
            bound[i] = held(open, ball);
            if (bound[i] > most) {
                most = bound[i];
                best = ball;
            }
        }
        if (most == 0 || balls.size() == most_) {
            return {};
        }
        best = moved(best, stand_off, open);
        const double square = best.radius * best.radius;
        std::erase_if(open, [&](const Vec3& p) { return squared_norm(p - best.center) <= square; });
        balls.push_back(best);
    }
    return balls;
}

std::vector<Sphere> Spawn::cover(std::size_t count, Context& context) {
    if (seeds_.empty() || points_.empty()) {
        return {};
    }
    const auto at = [&](double stand_off) -> const std::vector<Sphere>& {
        const auto known = known_.find(stand_off);
        return known != known_.end() ? known->second
                                     : known_.emplace(stand_off, placed(stand_off, context)).first->second;
    };
    double low = 0, high = greatest_ * (1 + 1e-6) + 1e-9;
    const std::vector<Sphere>* best = &at(high);
    for (int step = 0; step < 9; ++step) {
        const double middle = (low + high) / 2;
        const std::vector<Sphere>& balls = at(middle);
        if (!balls.empty() && balls.size() <= count) {
            best = &balls;
            high = middle;
        } else {
            low = middle;
        }
    }
    return *best;
}

} // namespace foam::medial
