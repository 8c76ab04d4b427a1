// Points of a plane: their smallest circle, the least rectangle, their hull.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

namespace foam::inline search::convex {

struct Vec2 {
    double x = 0, y = 0;
};
struct Circle {
    Vec2 center;
    double radius = 0;
};

/// Returns the smallest circle that contains the points, at least one, to rounding. The farthest point outside enters
/// the basis until there is none (the pivot rule of Gärtner 1999).
Circle smallest_circle(std::span<const Vec2> points);

struct Rectangle {
    Vec2 along{1, 0}; ///< unit direction of one side
    double area = 0;
};

/// Returns the rectangle of least area among those with a side along an edge of the points' hull, which has the least
/// one (Freeman and Shapira 1975). Sides count as at least `least` long. The points are sorted, and some dropped.
/// O(n log n); where corners of the hull coincide but for rounding, O(n log n + h²) for h of them.
Rectangle least_rectangle(std::vector<Vec2>& points, double least);

/// A point with two coordinates, and whatever else it carries.
template <class Point>
concept PointInPlane = requires(const Point& p) {
    { p.x } -> std::convertible_to<double>;
    { p.y } -> std::convertible_to<double>;
};

/// Returns twice the area of the triangle, positive if its corners are counter-clockwise.
template <PointInPlane Point> double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Returns the farthest points along eight directions, counter-clockwise.
template <PointInPlane Point> std::array<Point, 8> farthest_points(const std::vector<Point>& points) {
    const auto heights = [](const Point& p) {
        return std::array{p.x, p.x + p.y, p.y, p.y - p.x, -p.x, -p.x - p.y, -p.y, p.x - p.y};
    };
    std::array<Point, 8> farthest;
    farthest.fill(points.front());
    std::array<double, 8> most = heights(points.front());
    for (const Point& p : points) {
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
template <PointInPlane Point> void drop_inner(std::vector<Point>& points) {
    const std::array<Point, 8> corners = farthest_points(points);
    std::erase_if(points, [&](const Point& p) {
        bool inner = false; // not if all corners are one place
        for (std::size_t k = 0; k < 8; ++k) {
            const Point &a = corners[k], &b = corners[(k + 1) % 8];
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

/// Returns the hull, counter-clockwise (Andrew 1979). The points are sorted, and some dropped. O(n log n).
template <PointInPlane Point> std::vector<Point> hull_in_plane(std::vector<Point>& points) {
    constexpr std::size_t many = 64;
    if (points.size() > many) {
        drop_inner(points);
    }
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Point> hull(2 * points.size() + 1);
    std::size_t size = 0;
    const auto add = [&](const Point& p, std::size_t first) {
        while (size >= first + 2 && turn(hull[size - 2], hull[size - 1], p) <= 0) {
            --size;
        }
        hull[size++] = p;
    };
    for (const Point& p : points) {
        add(p, 0);
    }
    const std::size_t lower = size - 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) {
        add(points[i], lower);
    }
    hull.resize(std::max<std::size_t>(1, size - 1));
    return hull;
}

} // namespace foam::inline search::convex
