#include "optimise.hpp"

#include <foam/geometry/downhill.hpp>

#include <algorithm>

namespace foam::medial {
namespace {

double reach(const Vec3& center, std::span<const Vec3> points) {
    double square = 0;
    for (const Vec3& p : points) {
        square = std::max(square, squared_norm(p - center));
    }
    return std::sqrt(square);
}

/// Moves the ball to the place of least cost near its old one, with the others unchanged. Returns the gain.
double settle(std::vector<Sphere>& balls, std::size_t index, Uncovered& surface, const Columns& columns,
              int evaluations, double& cost) {
    const Sphere old = balls[index];
    const double shift = 0.15 * old.radius;
    const std::vector<Vec3> points = surface.needed(balls, index, shift, 2e-4);
    if (points.empty()) {
        return 0;
    }
    const Sphere stay{old.center, reach(old.center, points)};
    std::vector<Sphere> others = balls;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
    const Columns::Free free(columns, others, old.center, std::max(old.radius, stay.radius + 2 * shift));
    const auto value = [&](const Vec3& c) {
        return squared_norm(c - old.center) > shift * shift ? std::numeric_limits<double>::infinity()
                                                            : free.outside({c, reach(c, points)});
    };
    const auto middle = [](const auto&... places) { return (... + places) / double{sizeof...(places)}; };
    const auto ended = [&](const auto& v, int) {
        return squared_norm(middle(v[0].place, v[1].place, v[2].place) - v[3].place) < 1e-8 * shift * shift / 4;
    };
    const Vec3 place = downhill_simplex(old.center, shift / 2, evaluations, value, ended, middle);
    const Sphere moved{place, reach(place, points)};
    const double before = free.outside(old), here = free.outside(stay), there = free.outside(moved);
    balls[index] = there < here ? moved : stay;
    cost = std::min(here, there);
    return before - cost;
}

} // namespace

std::vector<Sphere> simplex(std::vector<Sphere> balls, Uncovered& surface, const Columns& columns,
                            const SimplexOptions& options, Context& context) {
    // Few balls settle quickly, and each has much weight.
    const auto count = static_cast<int>(std::min<std::size_t>(balls.size(), 1000));
    const int sweeps = std::max(options.sweeps, options.settlings / std::max(count, 1));
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        double gain = 0, total = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            context.check_cancelled();
            double cost = 0;
            gain += settle(balls, i, surface, columns, options.evaluations, cost);
            total += cost;
        }
        const double shortfall = surface.add_missed(balls, surface_resolution);
        if (gain < options.least_gain * total && shortfall < options.shortfall) {
            break;
        }
    }
    return balls;
}

} // namespace foam::medial
