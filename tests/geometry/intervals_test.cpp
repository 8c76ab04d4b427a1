// Intervals of lines against looking at every point of a grid of whole numbers.
#include "geometry/src/solid/intervals.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;

namespace {

constexpr int most = 24;
using Cells = std::array<bool, most>; ///< cell k lies between k and k + 1

Cells cells_of(const Intervals& intervals) {
    Cells cells{};
    for (const Solid::Interval& interval : intervals) {
        for (int k = static_cast<int>(interval.enter); k < static_cast<int>(interval.leave); ++k) {
            cells[static_cast<std::size_t>(k)] = true;
        }
    }
    return cells;
}

Intervals random_intervals(Random& random, int count) {
    Intervals intervals;
    for (int i = 0; i < count; ++i) {
        const double enter = std::floor(random.uniform(0, most - 1));
        intervals.push_back({enter, std::min(enter + std::floor(random.uniform(1, 8)), double(most))});
    }
    return intervals;
}

void expect_ascending(const Intervals& intervals, bool may_touch) {
    for (std::size_t i = 0; i < intervals.size(); ++i) {
        EXPECT_LT(intervals[i].enter, intervals[i].leave);
        if (i > 0) {
            EXPECT_TRUE(intervals[i - 1].leave < intervals[i].enter ||
                        (may_touch && intervals[i - 1].leave == intervals[i].enter));
        }
    }
}

} // namespace

TEST(Intervals, OfSets) {
    Random random(1);
    for (int round = 0; round < 2000; ++round) {
        Intervals a = random_intervals(random, round % 6), b = random_intervals(random, round / 6 % 6);
        const Cells in_a = cells_of(a), in_b = cells_of(b);
        unite(a);
        unite(b);
        expect_ascending(a, false);
        EXPECT_EQ(cells_of(a), in_a);
        const Intervals both = common(a, b);
        Intervals rest{{0, 1}};
        without(a, b, 0, rest);
        expect_ascending(both, true);
        expect_ascending(rest, true);
        const Cells in_both = cells_of(both), in_rest = cells_of(rest);
        int held = 0;
        for (std::size_t k = 0; k < most; ++k) {
            EXPECT_EQ(in_both[k], in_a[k] && in_b[k]);
            EXPECT_EQ(in_rest[k], in_a[k] && !in_b[k]);
            held += in_a[k];
        }
        EXPECT_EQ(length(a), held);
        without(a, b, 2, rest);
        for (const Solid::Interval& piece : rest) {
            EXPECT_GT(piece.leave - piece.enter, 2) << "what is not longer than the noise is left out";
        }
        Intervals longer;
        without(a, b, 0, longer);
        std::erase_if(longer, [](const Solid::Interval& piece) { return piece.leave - piece.enter <= 2; });
        EXPECT_EQ(length(longer), length(rest));
    }
}

TEST(Intervals, OfBalls) {
    Random random(2);
    for (int round = 0; round < 300; ++round) {
        std::vector<Sphere> balls, near;
        for (int i = round % 7; i >= 0; --i) {
            balls.push_back(
                {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, random.uniform(0.1, 0.8)});
        }
        const int axis = round % 3;
        const Vec3 origin{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        Intervals along_line{{5, 6}};
        balls_along(balls, origin, axis, along_line);
        expect_ascending(along_line, false);
        for (int k = -300; k <= 300; ++k) {
            const double at = k / 100.0;
            const Vec3 p = origin + along(axis) * at;
            const bool held = std::any_of(balls.begin(), balls.end(),
                                          [&](const Sphere& s) { return distance(p, s.center) < s.radius; });
            EXPECT_EQ(held, std::any_of(along_line.begin(), along_line.end(), [&](const Solid::Interval& piece) {
                          return piece.enter < at && at < piece.leave;
                      }));
        }
        const double from = random.uniform(-0.5, 0), to = random.uniform(0, 0.5);
        const Vec3 a = origin + along(axis) * from, b = origin + along(axis) * to;
        EXPECT_EQ(one_holds(balls, origin, axis, from, to),
                  std::any_of(balls.begin(), balls.end(), [&](const Sphere& s) {
                      return distance(a, s.center) <= s.radius && distance(b, s.center) <= s.radius;
                  }));
        balls_between(balls, axis, from, to, near);
        std::vector<Sphere> expected;
        for (const Sphere& s : balls) {
            if (s.center[axis] >= from - s.radius && s.center[axis] <= to + s.radius) {
                expected.push_back(s);
            }
        }
        EXPECT_EQ(near, expected);
    }
    const std::vector<Sphere> unit{{{}, 1}};
    Intervals line;
    balls_along(unit, {1, 0, 0}, 2, line);
    EXPECT_TRUE(line.empty()) << "a line that touches a ball is not in it";
    EXPECT_TRUE(one_holds(unit, {}, 0, -1, 1)) << "balls are closed";
    std::vector<Sphere> near;
    balls_between(unit, 0, 1, 2, near);
    EXPECT_EQ(near.size(), 1u);
    balls_between(unit, 0, -2, -1, near);
    EXPECT_EQ(near.size(), 1u);
}
