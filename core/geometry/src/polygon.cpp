// Ear clipping: Meisters, "Polygons have ears", American Mathematical Monthly 82 (1975).
#include <foam/geometry/polygon.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace foam::inline geometry {
namespace {

struct Point {
    double x, y;
    bool operator==(const Point&) const = default;
};

/// Returns twice the signed area of a triangle.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns Newell's normal: its length is twice the polygon's area.
Vec3 newell_normal(std::span<const Vec3> p) {
    Vec3 normal;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        normal += cross(p[i] - p[0], p[i + 1] - p[0]);
    }
    return normal;
}

/// Returns the projection of the polygon along the coordinate axis nearest to its normal, counter-clockwise.
std::vector<Point> projected(std::span<const Vec3> corners) {
    const Vec3 n = newell_normal(corners);
    int axis = std::abs(n.x) > std::abs(n.y) ? 0 : 1;
    axis = std::abs(n.z) > std::abs(n[axis]) ? 2 : axis;
    const double sign = n[axis] < 0 ? -1 : 1;
    std::vector<Point> points;
    points.reserve(corners.size());
    for (const Vec3& corner : corners) {
        const Vec3 p = corner - corners[0]; // near the origin, so that a distant part keeps its digits
        points.push_back({p[(axis + 1) % 3], sign * p[(axis + 2) % 3]});
    }
    return points;
}

class EarClipper {
public:
    EarClipper(std::vector<Point> points, std::size_t& work) : points_(std::move(points)), work_left_(work) {
        const auto n = static_cast<std::uint32_t>(points_.size());
        place_.assign(n, convex);
        next_.resize(n);
        previous_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            update(i);
        }
    }

    std::vector<Triangle> run() {
        std::vector<Triangle> triangles;
        std::uint32_t candidate = 1;
        std::size_t left = points_.size(), since_last = 0;
        while (left > 3) {
            if (since_last > left) {
                candidate = most_convex(candidate); // no ear: self-intersecting or flat; use the best corner
            } else if (!is_ear(candidate)) {
                candidate = next_[candidate];
                ++since_last;
                continue;
            }
            if (work_left_ == 0) {
                return {};
            }
            triangles.push_back({previous_[candidate], candidate, next_[candidate]});
            candidate = cut(candidate);
            --left;
            since_last = 0;
        }
        triangles.push_back({previous_[candidate], candidate, next_[candidate]});
        return triangles;
    }

private:
    static constexpr std::uint32_t convex = 0xFFFFFFFFu;

    double turn_at(std::uint32_t i) const { return turn(points_[previous_[i]], points_[i], points_[next_[i]]); }

    void spend(std::size_t work) { work_left_ -= std::min(work, work_left_); }

    /// Cuts a corner off. Returns the next one.
    std::uint32_t cut(std::uint32_t i) {
        const std::uint32_t before = previous_[i], after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        set_reflex(i, false);
        update(before);
        update(after);
        return after;
    }

    void update(std::uint32_t i) { set_reflex(i, turn_at(i) <= 0); }

    void set_reflex(std::uint32_t i, bool reflex) {
        if (reflex && place_[i] == convex) {
            place_[i] = static_cast<std::uint32_t>(reflex_.size());
            reflex_.push_back(i);
        } else if (!reflex && place_[i] != convex) {
            const std::uint32_t last = reflex_.back();
            reflex_[place_[i]] = last;
            place_[last] = place_[i];
            reflex_.pop_back();
            place_[i] = convex;
        }
    }

    /// Returns whether corner i is an ear. If any corner lies in the triangle of an ear, then a reflex one does.
    bool is_ear(std::uint32_t i) {
        spend(1);
        if (place_[i] != convex) {
            return false;
        }
        const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
        for (const std::uint32_t j : reflex_) {
            spend(1);
            const Point& p = points_[j];
            if (p == a || p == b || p == c) {
                continue; // a bridge to a hole has the same corner twice
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
            spend(1);
            if (turn_at(i) > turn_at(best)) {
                best = i;
            }
        }
        return best;
    }

    std::vector<Point> points_;
    std::vector<std::uint32_t> next_, previous_;
    std::vector<std::uint32_t> reflex_; ///< corners that are reflex or straight
    std::vector<std::uint32_t> place_;  ///< index of each corner in reflex_, or `convex`
    std::size_t& work_left_;
};

} // namespace

std::vector<Triangle> triangulated(std::span<const Vec3> corners, std::size_t& work) {
    return EarClipper(projected(corners), work).run();
}

} // namespace foam::inline geometry
