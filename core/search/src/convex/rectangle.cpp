#include "rectangle.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace foam::inline search::convex {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the hull, counter-clockwise (Andrew 1979).
std::vector<Vec2> hull_of(std::vector<Vec2>& points) {
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

double along(const Vec2& d, const Vec2& p) {
    return d.x * p.x + d.y * p.y;
}

} // namespace

Rectangle least_rectangle(std::vector<Vec2>& points, double least) {
    const std::vector<Vec2> hull = hull_of(points);
    const std::size_t n = hull.size();
    Rectangle best;
    bool found = false;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2& a = hull[i];
        const Vec2& b = hull[(i + 1) % n];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const Vec2 d = length > 0 ? Vec2{(b.x - a.x) / length, (b.y - a.y) / length} : Vec2{1, 0};
        const Vec2 up{-d.y, d.x};
        double left = along(d, a), right = left, bottom = along(up, a), top = bottom;
        for (const Vec2& p : hull) {
            left = std::min(left, along(d, p));
            right = std::max(right, along(d, p));
            bottom = std::min(bottom, along(up, p));
            top = std::max(top, along(up, p));
        }
        const double area = std::max(right - left, least) * std::max(top - bottom, least);
        if (!found || area < best.area) {
            best = {d, area};
            found = true;
        }
    }
    return best;
}

} // namespace foam::inline search::convex
