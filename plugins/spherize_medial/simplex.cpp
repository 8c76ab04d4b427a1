#include "optimise.hpp"

#include <algorithm>
#include <array>

namespace foam::medial {

Vec3 downhill_simplex(const Vec3& start, double size, int evaluations,
                      const std::function<double(const Vec3&)>& cost) {
    struct Vertex {
        Vec3 place;
        double cost;
    };
    const auto vertex = [&](const Vec3& place) {
        --evaluations;
        return Vertex{place, cost(place)};
    };
    // A regular tetrahedron about the start, which is a vertex itself.
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
    return std::min_element(v.begin(), v.end(), [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; })->place;
}

namespace {

double reach(const Vec3& center, std::span<const Vec3> points) {
    double square = 0;
    for (const Vec3& p : points) {
        square = std::max(square, squared_norm(p - center));
    }
    return std::sqrt(square);
}

/// The ball in its cheapest place near the old one, with the others as they are; its cost there.
double settle(std::vector<Sphere>& balls, std::size_t index, Uncovered& surface, const Columns& columns,
              int evaluations, double& before) {
    const Vec3 center = balls[index].center;
    const double shift = evaluations == 0 ? 0 : 0.15 * balls[index].radius;   // of the centre, at most
    const std::vector<Vec3> points = surface.needed(balls, index, shift);
    std::vector<Sphere> others = balls;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
    if (points.empty()) {
        before = 0;
        return 0;
    }
    const double radius = reach(center, points);
    const Columns::Free free(columns, others, center, std::max(balls[index].radius, radius + 2 * shift));
    before = free.outside(balls[index]);
    const auto cost = [&](const Vec3& c) {
        if (squared_norm(c - center) > shift * shift) {
            return std::numeric_limits<double>::infinity();
        }
        return free.outside({c, reach(c, points)});
    };
    const double here = free.outside({center, radius});
    if (evaluations == 0) {
        balls[index].radius = radius;
        return here;
    }
    const Vec3 there = downhill_simplex(center, shift / 2, evaluations, cost);
    const Sphere moved{there, reach(there, points)};
    const double after = free.outside(moved);
    balls[index] = after < here ? moved : Sphere{center, radius};
    return std::min(after, here);
}

} // namespace

std::vector<Sphere> simplex(std::vector<Sphere> balls, Uncovered& surface, const Columns& columns,
                            const SimplexOptions& options, Context& context) {
    for (int sweep = 0; sweep < options.sweeps; ++sweep) {
        double gain = 0, total = 0;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            context.check_cancelled();
            double before = 0;
            const double after = settle(balls, i, surface, columns, options.evaluations, before);
            gain += before - after;
            total += after;
        }
        if (gain < 2e-3 * total) {
            break;
        }
    }
    return balls;
}

} // namespace foam::medial
