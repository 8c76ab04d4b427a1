#include "columns.hpp"

#include <foam/base/parallel.hpp>

#include <algorithm>
#include <cstdint>

namespace foam::medial {
namespace {

/// Returns the points in the solid of a cubic lattice over the box of half edge 1/2 about the origin, which contains
/// it.
std::vector<Vec3> points_inside(const Columns& columns, int along) {
    std::vector<Vec3> points;
    const auto at = [&](int i) { return (i + 0.5) / along - 0.5; };
    for (int x = 0; x < along; ++x) {
        for (int y = 0; y < along; ++y) {
            for (int z = 0; z < along; ++z) {
                const Vec3 p{at(x), at(y), at(z)};
                if (columns.inside(p)) {
                    points.push_back(p);
                }
            }
        }
    }
    return points;
}

/// Returns enough points for a choice, also in slender solids that fill little of the lattice's box.
std::vector<Vec3> points_inside(const Columns& columns) {
    constexpr std::size_t enough = 3'000;
    std::vector<Vec3> points;
    for (int along = 24; along <= 96 && points.size() < enough; along *= 2) {
        points = points_inside(columns, along);
    }
    return points;
}

/// Returns the largest ball about a centre in the solid; its radius is not above zero outside of the solid.
Sphere ball_about(const Vec3& center, const Solid& solid, const Frame& frame) {
    return {center, -solid.signed_distance(frame.to_world(center)) / frame.scale};
}

/// Returns a larger ball nearby, by pattern search (Hooke and Jeeves 1961). In a spike it would take endless tiny
/// steps.
Sphere enlarged(Sphere best, const Solid& solid, const Frame& frame) {
    constexpr int most_steps = 1'000;
    double step = best.radius / 2;
    for (int n = 0; n < most_steps && step > best.radius / 20; ++n) {
        bool better = false;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-step, step}) {
                Vec3 next = best.center;
                next[axis] += side;
                if (const Sphere ball = ball_about(next, solid, frame); ball.radius > best.radius) {
                    best = ball;
                    better = true;
                }
            }
        }
        step = better ? step : step / 2;
    }
    return best;
}

} // namespace

std::vector<Sphere> inner_balls(const Solid& solid, const Frame& frame, const Columns& columns,
                                std::span<const Sphere> centers, std::size_t count, Context& context) {
    // The balls as given, and moved to where there is more room.
    std::vector<Sphere> balls(2 * centers.size());
    parallel_for(centers.size(), [&](std::size_t i) {
        balls[2 * i] = ball_about(centers[i].center, solid, frame);
        balls[2 * i + 1] = enlarged(balls[2 * i], solid, frame);
    });
    std::erase_if(balls, [](const Sphere& ball) { return !(ball.radius > 0); });
    std::stable_sort(balls.begin(), balls.end(), [](const Sphere& a, const Sphere& b) { return a.radius > b.radius; });
    const std::vector<Vec3> points = points_inside(columns);
    std::vector<std::vector<std::uint32_t>> held(balls.size());
    parallel_for(balls.size(), [&](std::size_t i) {
        for (std::uint32_t p = 0; p < points.size(); ++p) {
            if (distance(points[p], balls[i].center) <= balls[i].radius) {
                held[i].push_back(p);
            }
        }
    });
    std::vector<Sphere> chosen;
    std::vector<char> open(points.size(), 1);
    while (chosen.size() < count && !balls.empty()) {
        context.check_cancelled();
        std::vector<std::size_t> gain(balls.size());
        parallel_for(balls.size(), [&](std::size_t i) {
            gain[i] = static_cast<std::size_t>(
                std::count_if(held[i].begin(), held[i].end(), [&](std::uint32_t p) { return open[p] != 0; }));
        });
        const auto best = static_cast<std::size_t>(std::max_element(gain.begin(), gain.end()) - gain.begin());
        if (gain[best] == 0 && !chosen.empty()) {
            break; // the rest is finer than the lattice
        }
        chosen.push_back(balls[best]);
        for (const std::uint32_t p : held[best]) {
            open[p] = 0;
        }
    }
    return chosen;
}

} // namespace foam::medial
