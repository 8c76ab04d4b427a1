// The smallest circle and the least rectangle around points of a plane.
#include "plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

namespace foam::inline search::convex {
namespace {

double squared(const Vec2& a, const Vec2& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

Circle around(const Vec2& a, const Vec2& b) {
    const Vec2 middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    return {middle, std::sqrt(squared(a, b)) / 2};
}

std::optional<Circle> around(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double d = 2 * (bx * cy - by * cx);
    const double bb = bx * bx + by * by, cc = cx * cx + cy * cy;
    if (!(std::abs(d) > 1e-14 * (bb + cc))) {
        return std::nullopt;
    }
    const double ux = (cy * bb - by * cc) / d, uy = (bx * cc - cx * bb) / d;
    return Circle{{a.x + ux, a.y + uy}, std::sqrt(ux * ux + uy * uy)};
}

bool holds(const Circle& circle, const Vec2& p) {
    return squared(circle.center, p) <= circle.radius * circle.radius * (1 + 1e-12);
}

/// A basis: at most three points on the circle.
struct Basis {
    std::array<Vec2, 3> points;
    std::size_t size = 0;
    Circle circle;
};

/// Returns the basis of the smallest circle around the points of a basis and another point, which lies on it.
Basis with(const Basis& before, const Vec2& p) {
    Basis best;
    const auto offer = [&](const Basis& candidate) {
        for (std::size_t i = 0; i < before.size; ++i) {
            if (!holds(candidate.circle, before.points[i])) {
                return;
            }
        }
        if (best.size == 0 || candidate.circle.radius < best.circle.radius) {
            best = candidate;
        }
    };
    for (std::size_t i = 0; i < before.size; ++i) {
        offer({{p, before.points[i], {}}, 2, around(p, before.points[i])});
        for (std::size_t j = i + 1; j < before.size; ++j) {
            if (const auto circle = around(p, before.points[i], before.points[j])) {
                offer({{p, before.points[i], before.points[j]}, 3, *circle});
            }
        }
    }
    return best;
}

} // namespace

Circle smallest_circle(std::span<const Vec2> points) {
    const auto farthest = [&](const Vec2& from) {
        std::size_t best = 0;
        double most = -1;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (const double d = squared(points[i], from); d > most) {
                most = d;
                best = i;
            }
        }
        return points[best];
    };
    const Vec2 a = farthest(points.front()), b = farthest(a);
    Basis basis{{a, b, {}}, 2, around(a, b)};
    for (int round = 0; round < 100; ++round) {
        const Vec2 p = farthest(basis.circle.center);
        if (holds(basis.circle, p)) {
            break;
        }
        const Basis next = with(basis, p);
        if (next.size == 0 || !(next.circle.radius > basis.circle.radius)) {
            break;
        }
        basis = next;
    }
    const Vec2 p = farthest(basis.circle.center);
    basis.circle.radius = std::sqrt(squared(p, basis.circle.center));
    return basis.circle;
}

namespace {

double along(const Vec2& d, const Vec2& p) {
    return d.x * p.x + d.y * p.y;
}

Vec2 direction_of(const Vec2& a, const Vec2& b) {
    const double x = b.x - a.x, y = b.y - a.y, length = std::sqrt(x * x + y * y);
    return length > 0 ? Vec2{x / length, y / length} : Vec2{1, 0};
}

/// Returns the rectangle around the hull with a side along a direction.
Rectangle rectangle_along(const std::vector<Vec2>& hull, const Vec2& d, double least) {
    const Vec2 up{-d.y, d.x};
    double left = along(d, hull.front()), right = left, bottom = along(up, hull.front()), top = bottom;
    for (const Vec2& p : hull) {
        left = std::min(left, along(d, p));
        right = std::max(right, along(d, p));
        bottom = std::min(bottom, along(up, p));
        top = std::max(top, along(up, p));
    }
    return {d, std::max(right - left, least) * std::max(top - bottom, least)};
}

/// Returns the least rectangle by calipers that turn around the hull (Toussaint 1983). Where corners coincide but for
/// rounding they may stop early: the area is then too small.
Rectangle by_calipers(const std::vector<Vec2>& hull, double least) {
    const std::size_t n = hull.size();
    const auto corner = [&](std::size_t i) -> const Vec2& { // much quicker than a division
        while (i >= n) {
            i -= n;
        }
        return hull[i];
    };
    // Goes on from a corner to the farthest in a direction: the height rises to it and falls from there.
    const auto climb = [&](std::size_t& at, std::size_t from, const Vec2& d) {
        at = std::max(at, from);
        for (std::size_t steps = 0; steps < n && along(d, corner(at + 1)) > along(d, corner(at)); ++steps) {
            ++at;
        }
        return along(d, corner(at));
    };
    Rectangle best{.area = std::numeric_limits<double>::infinity()};
    std::size_t right = 1, top = 1, left = 1;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 d = direction_of(hull[i], corner(i + 1)), up{-d.y, d.x};
        const double most_right = climb(right, i + 1, d);
        const double height = climb(top, right, up) - along(up, hull[i]);
        const double width = most_right + climb(left, top, {-d.x, -d.y});
        if (const double area = std::max(width, least) * std::max(height, least); area < best.area) {
            best = {d, area};
        }
    }
    return best;
}

} // namespace

Rectangle least_rectangle(std::vector<Vec2>& points, double least) {
    constexpr double rounding = 1e-9;
    const std::vector<Vec2> hull = hull_in_plane(points);
    const Rectangle found = by_calipers(hull, least);
    Rectangle best = rectangle_along(hull, found.along, least);
    if (best.area > found.area * (1 + rounding)) {
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Vec2 d = direction_of(hull[i], hull[(i + 1) % hull.size()]);
            if (const Rectangle other = rectangle_along(hull, d, least); other.area < best.area) {
                best = other;
            }
        }
    }
    return best;
}

} // namespace foam::inline search::convex
