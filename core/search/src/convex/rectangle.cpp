#include "rectangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace foam::inline search::convex {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double along(const Vec2& d, const Vec2& p) {
    return d.x * p.x + d.y * p.y;
}

/// Returns the farthest points along eight directions, counter-clockwise.
std::array<Vec2, 8> farthest_points(const std::vector<Vec2>& points) {
    const auto heights = [](const Vec2& p) {
        return std::array{p.x, p.x + p.y, p.y, p.y - p.x, -p.x, -p.x - p.y, -p.y, p.x - p.y};
    };
    std::array<Vec2, 8> farthest;
    farthest.fill(points.front());
    std::array<double, 8> most = heights(points.front());
    for (const Vec2& p : points) {
        const std::array<double, 8> height = heights(p);
        for (std::size_t k = 0; k < 8; ++k) {
            if (height[k] > most[k]) {
                most[k] = height[k];
                farthest[k] = p;
            }
        }
    }
    return farthest;
}

/// Drops points inside the octagon of the farthest ones along eight directions (Akl and Toussaint 1978).
void drop_inner(std::vector<Vec2>& points) {
    const std::array<Vec2, 8> corners = farthest_points(points);
    std::erase_if(points, [&](const Vec2& p) {
        bool inner = false; // not if all corners are one place
        for (std::size_t k = 0; k < 8; ++k) {
            const Vec2 &a = corners[k], &b = corners[(k + 1) % 8];
            if (a.x == b.x && a.y == b.y) {
                continue;
            }
            inner = turn(a, b, p) > 0;
            if (!inner) {
                return false;
            }
        }
        return inner;
    });
}

/// Returns the hull, counter-clockwise (Andrew 1979).
std::vector<Vec2> hull_of(std::vector<Vec2>& points) {
    constexpr std::size_t many = 64;
    if (points.size() > many) {
        drop_inner(points);
    }
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Vec2> hull(2 * points.size() + 1);
    std::size_t size = 0;
    const auto add = [&](const Vec2& p, std::size_t first) {
        while (size >= first + 2 && turn(hull[size - 2], hull[size - 1], p) <= 0) {
            --size;
        }
        hull[size++] = p;
    };
    for (const Vec2& p : points) {
        add(p, 0);
    }
    const std::size_t lower = size - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) {
        add(points[i], lower);
    }
    hull.resize(std::max<std::size_t>(1, size - 1));
    return hull;
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
    const auto corner = [&](std::size_t i) -> const Vec2& { return hull[i % n]; };
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
    const std::vector<Vec2> hull = hull_of(points);
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
