// The least rectangle around points of a plane, against all directions of the hull's edges.
#include "search/src/convex/plane.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace foam;
using namespace foam::search::convex;

/// Returns the area of the rectangle around the points along a direction.
double area_along(const std::vector<Vec2>& points, const Vec2& d, double least) {
    double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
    for (const Vec2& p : points) {
        left = std::min(left, d.x * p.x + d.y * p.y);
        right = std::max(right, d.x * p.x + d.y * p.y);
        bottom = std::min(bottom, d.x * p.y - d.y * p.x);
        top = std::max(top, d.x * p.y - d.y * p.x);
    }
    return std::max(right - left, least) * std::max(top - bottom, least);
}

/// Expects the rectangle to be as small as that along the line through any two points.
void expect_least(const std::vector<Vec2>& points) {
    constexpr double least = 1e-6;
    std::vector<Vec2> sorted = points;
    const Rectangle found = least_rectangle(sorted, least);
    EXPECT_NEAR(std::hypot(found.along.x, found.along.y), 1, 1e-12);
    EXPECT_NEAR(found.area, area_along(points, found.along, least), 1e-8 * found.area);
    for (const Vec2& a : points) {
        for (const Vec2& b : points) {
            if (const double length = std::hypot(b.x - a.x, b.y - a.y); length > 1e-9) {
                const Vec2 d{(b.x - a.x) / length, (b.y - a.y) / length};
                ASSERT_LE(found.area, area_along(points, d, least) * (1 + 1e-8));
            }
        }
    }
}

TEST(LeastRectangle, OfRandomPoints) {
    Random random(3);
    for (int run = 0; run < 60; ++run) {
        std::vector<Vec2> points;
        const int count = 1 + run * 2;
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * random.uniform(), r = run % 2 ? 1 : random.uniform();
            points.push_back({r * std::cos(angle), 0.4 * r * std::sin(angle)});
        }
        expect_least(points);
    }
}

TEST(LeastRectangle, OfOnePlaceAndOfALine) {
    expect_least(std::vector<Vec2>(100, {0.3, 0.1}));
    std::vector<Vec2> line;
    for (int i = 0; i < 100; ++i) {
        line.push_back({0.01 * i, 0.02 * i});
    }
    expect_least(line);
}

TEST(LeastRectangle, OfCornersThatCoincideButForRounding) {
    Random random(4);
    for (int run = 0; run < 40; ++run) {
        const double angle = random.uniform();
        std::vector<Vec2> points;
        for (int i = 0; i < 80; ++i) {
            const double x = (i & 1 ? 1 : -1) + 1e-16 * random.uniform(),
                         y = (i & 2 ? 0.5 : -0.5) * (run % 3 == 0 ? 0 : 1);
            points.push_back({x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)});
        }
        expect_least(points);
    }
}

} // namespace
