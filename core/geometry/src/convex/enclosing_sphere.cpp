// The smallest ball around points, a small one around balls, and the level of one ball around a model.
#include <foam/base/cancellation.hpp>
#include <foam/base/hypot.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/sphere.hpp>

#include <array>
#include <list>

namespace foam::inline geometry {
namespace {

/// Smallest enclosing ball after Welzl 1991 with the move-to-front and pivoting of Gärtner 1999 ("Fast and robust
/// smallest enclosing balls"): the ball through up to four support points is built up one point at a time.
class EnclosingBall {
public:
    explicit EnclosingBall(std::span<const Vec3> points) : points_(points.begin(), points.end()) {}

    Sphere solve() {
        auto examined = std::next(points_.begin());
        move_to_front_pass(examined);
        double previous = -1;
        double excess = 0;
        do {
            Iterator pivot;
            excess = largest_excess(examined, pivot);
            if (excess > 0) {
                examined = support_end_;
                if (examined == pivot) {
                    ++examined;
                }
                previous = squared_radius_;
                if (push(*pivot)) {
                    move_to_front_pass(support_end_);
                    --count_;
                }
                move_to_front(pivot);
            }
        } while (excess > 0 && squared_radius_ > previous);
        return {center_, std::sqrt(std::max(0.0, squared_radius_))};
    }

private:
    using Iterator = std::list<Vec3>::iterator;

    double largest_excess(Iterator begin, Iterator& pivot) {
        double largest = 0;
        for (auto it = begin; it != points_.end(); ++it) {
            const double excess = squared_norm(*it - center_) - squared_radius_;
            if (excess > largest) {
                largest = excess;
                pivot = it;
            }
        }
        return largest;
    }

    void move_to_front(Iterator it) {
        if (support_end_ == it) {
            ++support_end_;
        }
        points_.splice(points_.begin(), points_, it);
    }

    void move_to_front_pass(Iterator end) {
        support_end_ = points_.begin();
        if (count_ == 4) {
            return;
        }
        for (auto it = points_.begin(); it != end;) {
            const auto current = it++;
            if (squared_norm(*current - center_) > squared_radius_ && push(*current)) {
                move_to_front_pass(current);
                --count_;
                move_to_front(current);
            }
        }
    }

    /// Adds a point to the boundary. Returns false if it depends affinely on the present ones.
    bool push(const Vec3& point) {
        const std::size_t m = count_;
        if (m == 0) {
            first_ = point;
            ball_center_[0] = point;
            ball_squared_radius_[0] = 0;
        } else {
            offset_[m] = point - first_;
            for (std::size_t i = 1; i < m; ++i) {
                coefficient_[m][i] = 2 * dot(offset_[i], point - first_) / z_[i];
            }
            for (std::size_t i = 1; i < m; ++i) {
                offset_[m] -= coefficient_[m][i] * offset_[i];
            }
            z_[m] = 2 * squared_norm(offset_[m]);
            if (z_[m] <= 1e-20 * squared_radius_) {
                return false;
            }
            const double e = squared_norm(point - ball_center_[m - 1]) - ball_squared_radius_[m - 1];
            const double f = e / z_[m];
            ball_center_[m] = ball_center_[m - 1] + f * offset_[m];
            ball_squared_radius_[m] = ball_squared_radius_[m - 1] + e * f / 2;
        }
        center_ = ball_center_[m];
        squared_radius_ = ball_squared_radius_[m];
        ++count_;
        return true;
    }

    std::list<Vec3> points_;
    Iterator support_end_{};
    std::size_t count_ = 0;
    Vec3 first_{}, center_{};
    double squared_radius_ = -1;
    std::array<Vec3, 4> offset_{}, ball_center_{};
    std::array<double, 4> z_{}, ball_squared_radius_{};
    std::array<std::array<double, 4>, 4> coefficient_{};
};

Sphere grown_to_hold(Sphere sphere, std::span<const Vec3> points) {
    for (const Vec3& point : points) {
        sphere.radius = std::max(sphere.radius, distance(point, sphere.center));
    }
    return sphere;
}

void shuffle(std::vector<Vec3>& points, Random& random) {
    for (std::size_t i = points.size(); i > 1; --i) {
        std::swap(points[i - 1], points[static_cast<std::size_t>(random.below(i))]);
    }
}

/// Returns the smallest ball of a few points, at least one.
Sphere smallest_of_few(std::span<const Vec3> points) {
    // Where many points lie on the ball, rounding can end the search before the ball contains them all; another order
    // may succeed. A ball that needs no growth is the smallest.
    constexpr double rounding = 1e-6;
    constexpr int orders = 32;
    std::vector<Vec3> ordered(points.begin(), points.end());
    Random random(points.size());
    Sphere best;
    for (int order = 0; order < orders; ++order) {
        const Sphere found = EnclosingBall(ordered).solve();
        const Sphere grown = grown_to_hold(found, points);
        if (order == 0 || grown.radius < best.radius) {
            best = grown;
        }
        if (!(grown.radius > (1 + rounding) * found.radius)) {
            break;
        }
        shuffle(ordered, random);
    }
    return best;
}

std::size_t farthest(std::span<const Vec3> points, const Vec3& center) {
    std::size_t index = 0;
    double largest = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double d = squared_norm(points[i] - center);
        if (d > largest) {
            largest = d;
            index = i;
        }
    }
    return index;
}

/// Returns the smallest ball of many points: the farthest point joins a small support set until none is outside (the
/// pivot rule of Gärtner 1999). About ten passes over the points.
Sphere smallest_of_many(std::span<const Vec3> points) {
    const Vec3 a = points[farthest(points, points[0])];
    const Vec3 b = points[farthest(points, a)];
    std::vector<Vec3> support{a, b};
    Sphere ball{(a + b) * 0.5, distance(a, b) / 2};
    for (int pass = 0; pass < 100; ++pass) {
        check_cancelled();
        const Vec3 pivot = points[farthest(points, ball.center)];
        if (distance(pivot, ball.center) <= ball.radius * (1 + 1e-12)) {
            break;
        }
        support.push_back(pivot);
        const Sphere next = smallest_of_few(support);
        if (!(next.radius > ball.radius)) {
            break; // rounding only
        }
        ball = next;
        std::erase_if(support, [&](const Vec3& p) { return distance(p, ball.center) < ball.radius * (1 - 1e-9); });
    }
    return grown_to_hold(ball, points);
}

} // namespace

Sphere minimum_enclosing_sphere(std::span<const Vec3> points) {
    constexpr std::size_t few = 16;
    return points.empty() ? Sphere{} : points.size() <= few ? smallest_of_few(points) : smallest_of_many(points);
}

Sphere enclosing_sphere(const Sphere& a, const Sphere& b) {
    const double d = distance(a.center, b.center);
    if (d + b.radius <= a.radius) {
        return a;
    }
    if (d + a.radius <= b.radius) {
        return b;
    }
    const double radius = (d + a.radius + b.radius) / 2;
    return {a.center + (b.center - a.center) * ((radius - a.radius) / d), radius};
}

Sphere enclosing_sphere(const std::vector<Sphere>& spheres) {
    if (spheres.empty()) {
        return {};
    }
    // Badoiu and Clarkson 2003: steps of 1/(i+1) towards the farthest ball converge to within 1/i of the optimum.
    std::vector<Vec3> centers;
    for (const Sphere& s : spheres) {
        centers.push_back(s.center);
    }
    Vec3 center = minimum_enclosing_sphere(centers).center;
    Sphere best{center, std::numeric_limits<double>::infinity()};
    for (int i = 1; i <= 500; ++i) {
        double reach = 0;
        Vec3 target = center;
        for (const Sphere& s : spheres) {
            const double d = distance(center, s.center);
            if (d + s.radius > reach) {
                reach = d + s.radius;
                target = d > 0 ? center + (s.center - center) * (reach / d) : center;
            }
        }
        if (reach < best.radius) {
            best = {center, reach};
        }
        center += (target - center) / (i + 1.0);
    }
    return best;
}

namespace {

/// Appends balls whose hull contains the element, and is little larger.
void add_balls_around(const Element& e, std::vector<Sphere>& balls) {
    if (e.kind == Element::Kind::hull) {
        const Sphere ball = minimum_enclosing_sphere(e.hull->surface.vertices);
        balls.push_back({e.pose * ball.center, ball.radius});
        return;
    }
    if (e.kind == Element::Kind::cylinder) {
        balls.push_back({e.pose.translation, foam::hypot(e.radius, e.half.z)});
        return;
    }
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at{corner & 1 ? e.half.x : -e.half.x, corner & 2 ? e.half.y : -e.half.y,
                      corner & 4 ? e.half.z : -e.half.z};
        balls.push_back({e.pose * at, e.radius});
    }
}

} // namespace

Approximation flat_tree(Elements elements) {
    std::vector<Sphere> balls = elements.spheres();
    for (const Element& e : elements.shaped()) {
        add_balls_around(e, balls);
    }
    Approximation result;
    result.levels.resize(2);
    result.levels[0].elements = {enclosing_sphere(balls)};
    result.levels[1].parents.assign(elements.size(), 0);
    result.levels[1].elements = std::move(elements);
    return result;
}

} // namespace foam::inline geometry
