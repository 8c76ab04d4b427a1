#include "reduction.hpp"

#include <algorithm>

namespace foam::medial {
namespace {

struct Removal {
    double cost = std::numeric_limits<double>::infinity();
    std::vector<Sphere> balls;
};

/// Returns the balls without `gone`. Its points go to the balls that they lie outside of least; these become the
/// enclosing balls of their points.
Removal without(std::size_t gone, std::span<const Sphere> balls, const std::vector<std::vector<Vec3>>& groups,
                const Columns& columns) {
    Removal result;
    result.balls.assign(balls.begin(), balls.end());
    result.balls.erase(result.balls.begin() + static_cast<std::ptrdiff_t>(gone));
    const auto owner = assign(groups[gone], result.balls);
    const auto moved = grouped(groups[gone], owner, result.balls.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
        if (!moved[i].empty()) {
            std::vector<Vec3> points = groups[i < gone ? i : i + 1];
            points.insert(points.end(), moved[i].begin(), moved[i].end());
            result.balls[i] = minimum_enclosing_sphere(points);
        }
    }
    result.cost = columns.outside(result.balls);
    return result;
}

} // namespace

std::vector<Sphere> burst(std::span<const Vec3> points, std::vector<Sphere> balls, std::size_t count,
                          const Columns& columns, Context& context) {
    while (balls.size() > count) {
        context.check_cancelled();
        const auto groups = grouped(points, assign(points, balls), balls.size());
        Removal best;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            Removal removal = without(i, balls, groups, columns);
            if (removal.cost < best.cost || best.balls.empty()) {
                best = std::move(removal);
            }
        }
        balls = std::move(best.balls);
    }
    return balls;
}

} // namespace foam::medial
