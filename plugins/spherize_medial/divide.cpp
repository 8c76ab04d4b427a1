#include "optimise.hpp"

#include <foam/geometry/vector.hpp>

#include <algorithm>

namespace foam::medial {
namespace {

struct Part {
    std::vector<Vec3> points;
    Sphere ball;
    double cost = 0;          ///< volume of the ball outside the solid
    std::vector<Part> halves; ///< two for the best known division; none if there is none
    double saving = 0;        ///< cost less that of the halves
};

Part part(std::vector<Vec3> points, const Columns& columns) {
    Part result;
    result.points = std::move(points);
    result.ball = minimum_enclosing_sphere(result.points);
    result.cost = columns.outside(std::span(&result.ball, 1));
    return result;
}

/// Returns at most `count` of the points, evenly from the list, and the outermost ones, which determine the enclosing
/// balls.
std::vector<Vec3> thinned(const std::vector<Vec3>& points, const std::vector<Vec3>& directions, std::size_t count) {
    if (points.size() <= count) {
        return points;
    }
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < count; ++i) {
        result.push_back(points[i * points.size() / count]);
    }
    for (const Vec3& d : directions) {
        result.push_back(*std::max_element(points.begin(), points.end(),
                                           [&](const Vec3& a, const Vec3& b) { return dot(a, d) < dot(b, d); }));
    }
    return result;
}

/// Finds the plane of `directions` and some offsets for which the two enclosing balls have the least cost together.
void find_division(Part& whole, const std::vector<Vec3>& directions, const Columns& columns) {
    constexpr int offsets = 7;
    const std::vector<Vec3> points = thinned(whole.points, directions, 300);
    double least = std::numeric_limits<double>::infinity(), best_offset = 0;
    Vec3 best_direction{};
    std::vector<Vec3> below, above;
    for (const Vec3& direction : directions) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec3& p : points) {
            low = std::min(low, dot(p, direction));
            high = std::max(high, dot(p, direction));
        }
        if (!(high - low > 1e-9)) {
            continue;
        }
        for (int i = 1; i <= offsets; ++i) {
            const double offset = low + (high - low) * i / (offsets + 1);
            below.clear();
            above.clear();
            for (const Vec3& p : points) {
                (dot(p, direction) <= offset ? below : above).push_back(p);
            }
            const std::array<Sphere, 2> balls{minimum_enclosing_sphere(below), minimum_enclosing_sphere(above)};
            const double cost = columns.outside(balls);
            if (cost < least) {
                least = cost;
                best_offset = offset;
                best_direction = direction;
            }
        }
    }
    if (least == std::numeric_limits<double>::infinity()) {
        return;
    }
    below.clear();
    above.clear();
    for (const Vec3& p : whole.points) {
        (dot(p, best_direction) <= best_offset ? below : above).push_back(p);
    }
    whole.halves.push_back(part(std::move(below), columns));
    whole.halves.push_back(part(std::move(above), columns));
    whole.saving = whole.cost - whole.halves[0].cost - whole.halves[1].cost;
}

} // namespace

std::vector<std::vector<Sphere>> divide(std::span<const Vec3> points, std::size_t count, const Columns& columns,
                                        Context& context) {
    // Half of the directions would suffice (a plane has two), but the lattice has no antipodes to drop.
    std::vector<Vec3> directions = fibonacci_directions(12);
    directions.insert(directions.end(), {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}});
    std::vector<Part> parts{part({points.begin(), points.end()}, columns)};
    find_division(parts[0], directions, columns);
    std::vector<std::vector<Sphere>> results;
    for (;;) {
        std::vector<Sphere>& balls = results.emplace_back();
        for (const Part& p : parts) {
            balls.push_back(p.ball);
        }
        if (results.size() >= count) {
            return results;
        }
        std::size_t best = parts.size();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (!parts[i].halves.empty() && (best == parts.size() || parts[i].saving > parts[best].saving)) {
                best = i;
            }
        }
        if (best == parts.size()) {
            return results;
        }
        context.check_cancelled();
        std::vector<Part> halves = std::move(parts[best].halves);
        for (Part& half : halves) {
            find_division(half, directions, columns);
        }
        parts[best] = std::move(halves[0]);
        parts.push_back(std::move(halves[1]));
    }
}

} // namespace foam::medial
