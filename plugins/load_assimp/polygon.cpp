// Ear clipping: Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).
#include "builder.hpp"

#include <array>
#include <cstddef>

namespace foam::load_assimp {
namespace {

struct Point {
    double x, y;
    bool operator==(const Point&) const = default;
};

/// Twice the signed area of a triangle.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Newell's normal: its length is twice the polygon's area.
Vec3 newell_normal(std::span<const Vec3> p) {
    Vec3 normal;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        normal += cross(p[i] - p[0], p[i + 1] - p[0]);
    }
    return normal;
}

/// The polygon seen along the coordinate axis nearest to its normal, counter-clockwise.
std::vector<Point> projected(std::span<const Vec3> corners) {
    const Vec3 n = newell_normal(corners);
    int axis = std::abs(n.x) > std::abs(n.y) ? 0 : 1;
    axis = std::abs(n.z) > std::abs(n[axis]) ? 2 : axis;
    const double sign = n[axis] < 0 ? -1 : 1;
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Vec3& corner : corners) {
        const Vec3 p = corner - corners[0]; // near the origin, so that a part far away keeps its digits
        points.push_back({p[(axis + 1) % 3], sign * p[(axis + 2) % 3]});
    }
    return points;
}

class EarClipper {
public:
    explicit EarClipper(std::vector<Point> points) : points_(std::move(points)) {
        const auto n = static_cast<std::uint32_t>(points_.size());
        next_.resize(n);
        previous_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
    }

    std::vector<Triangle> run() {
        std::vector<Triangle> triangles;
        std::uint32_t candidate = 1;
        std::size_t left = points_.size(), since_last = 0;
        while (left > 3) {
            if (since_last > left) {
                candidate = most_convex(candidate); // no ear: it crosses itself or is flat; go on with the best corner
            } else if (!is_ear(candidate)) {
                candidate = next_[candidate];
                ++since_last;
                continue;
            }
            if (work_ > most_work) {
                return {};
            }
            triangles.push_back({previous_[candidate], candidate, next_[candidate]});
            next_[previous_[candidate]] = next_[candidate];
            previous_[next_[candidate]] = previous_[candidate];
            candidate = next_[candidate];
            --left;
            since_last = 0;
        }
        triangles.push_back({previous_[candidate], candidate, next_[candidate]});
        return triangles;
    }

private:
    static constexpr std::size_t most_work = 400'000'000; ///< corners looked at; some seconds

    double turn_at(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }

    bool is_ear(std::uint32_t i) {
        ++work_;
        if (turn_at(i) <= 0) {
            return false;
        }
        const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
        for (std::uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
            ++work_;
            const Point& p = points_[j];
            if (p == a || p == b || p == c) {
                continue; // a bridge to a hole passes the same corner twice
            }
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) {
                return false;
            }
        }
        return true;
    }

    std::uint32_t most_convex(std::uint32_t start) {
        std::uint32_t best = start;
        for (std::uint32_t i = next_[start]; i != start; i = next_[i]) {
            ++work_;
            if (turn_at(i) > turn_at(best)) {
                best = i;
            }
        }
        return best;
    }

    std::vector<Point> points_;
    std::vector<std::uint32_t> next_, previous_;
    std::size_t work_ = 0;
};

} // namespace

std::vector<Triangle> triangulated(std::span<const Vec3> corners) {
    return EarClipper(projected(corners)).run();
}

} // namespace foam::load_assimp
