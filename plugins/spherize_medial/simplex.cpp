#include "optimise.hpp"

#include <algorithm>
#include <array>

namespace foam::medial {

Vec3 downhill_simplex(const Vec3& start, double size, int evaluations, const std::function<double(const Vec3&)>& cost) {
    struct Vertex {
        Vec3 place;
        double cost;
    };
    const auto vertex = [&](const Vec3& place) {
        --evaluations;
        return Vertex{place, cost(place)};
    };
    // A regular tetrahedron about the start, which is a vertex.
    std::array<Vertex, 4> v{vertex(start), vertex(start + Vec3{size, 0, 0}), vertex(start + Vec3{0, size, 0}),
                            vertex(start + Vec3{0, 0, size})};
    while (evaluations > 0) {
        std::stable_sort(v.begin(), v.end(), [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; });
        const Vec3 middle = (v[0].place + v[1].place + v[2].place) / 3.0, away = middle - v[3].place;
        if (squared_norm(away) < 1e-8 * size * size) {
            break;
        }
        const Vertex reflected = vertex(middle + away);
        if (reflected.cost < v[0].cost) {
            const Vertex expanded = vertex(middle + away * 2);
            v[3] = expanded.cost < reflected.cost ? expanded : reflected;
        } else if (reflected.cost < v[2].cost) {
            v[3] = reflected;
        } else {
            const Vertex contracted = vertex(middle + away * (reflected.cost < v[3].cost ? 0.5 : -0.5));
            if (contracted.cost < std::min(reflected.cost, v[3].cost)) {
                v[3] = contracted;
            } else {
                for (std::size_t i = 1; i < 4; ++i) {
                    v[i] = vertex((v[0].place + v[i].place) * 0.5);
                }
            }
        }
    }
    return std::min_element(v.begin(), v.end(), [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; })
        ->place;
}

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
    const Vec3 place = downhill_simplex(old.center, shift / 2, evaluations, [&](const Vec3& c) {
        if (squared_norm(c - old.center) > shift * shift) {
            return std::numeric_limits<double>::infinity();
        }
        return free.outside({c, reach(c, points)});
    });
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
