// The point of a simplex that is closest to the origin, by what characterises it.
#include "collision/src/simplex.hpp"

#include <foam/base/random.hpp>

#include <gtest/gtest.h>

#include <set>

namespace foam {
namespace {

Vec3 at_random(Random& random, double from, double to) {
    const double x = random.uniform(from, to), y = random.uniform(from, to);
    return {x, y, random.uniform(from, to)};
}

/// Expects the closest point of the corners: a combination of those that are left, and no corner is nearer in its
/// direction. That is so for the closest point alone.
void expect_closest(const std::vector<Simplex::Corner>& corners) {
    Simplex simplex;
    for (const Simplex::Corner& corner : corners) {
        simplex.add(corner);
    }
    ASSERT_EQ(simplex.size, corners.size());
    const Vec3 closest = simplex.closest();
    ASSERT_GE(simplex.size, 1u);
    Vec3 point, in_first;
    double sum = 0;
    for (std::size_t i = 0; i < simplex.size; ++i) {
        ASSERT_GT(simplex.weights[i], 0);
        const auto is_this = [&](const Simplex::Corner& c) {
            return c.point == simplex.corners[i].point && c.in_first == simplex.corners[i].in_first;
        };
        ASSERT_TRUE(std::any_of(corners.begin(), corners.end(), is_this));
        sum += simplex.weights[i];
        point += simplex.corners[i].point * simplex.weights[i];
        in_first += simplex.corners[i].in_first * simplex.weights[i];
    }
    EXPECT_NEAR(sum, 1, 1e-9);
    EXPECT_LE(distance(point, closest), 1e-9);
    EXPECT_LE(distance(in_first, simplex.in_first()), 1e-12);
    for (const Simplex::Corner& corner : corners) {
        EXPECT_GE(dot(closest, corner.point), squared_norm(closest) - 1e-9);
    }
    EXPECT_EQ(simplex.size == 4, norm(closest) == 0 && corners.size() == 4);
}

TEST(Simplex, TheClosestPointOfUpToFourCorners) {
    Random random(1);
    std::set<std::size_t> left_of_four;
    for (int round = 0; round < 4000; ++round) {
        const double away = round % 3 == 0 ? -1 : random.uniform(-1, 0.5);
        std::vector<Simplex::Corner> corners;
        for (int i = 0; i <= round % 4; ++i) {
            corners.push_back({at_random(random, away, 1), at_random(random, -3, 3)});
        }
        expect_closest(corners);
        if (corners.size() == 4) {
            Simplex simplex;
            for (const Simplex::Corner& corner : corners) {
                simplex.add(corner);
            }
            simplex.closest();
            left_of_four.insert(simplex.size);
        }
    }
    EXPECT_EQ(left_of_four, (std::set<std::size_t>{1, 2, 3, 4})) << "else this test says little";
}

TEST(Simplex, CornersThatDegenerate) {
    // The same corner twice, three on a line, four in a plane: the closest point is what it is of fewer.
    const Vec3 a{1, 1, 0}, b{-1, 1, 0}, c{0, 1, 0}, d{0, 2, 0.5}, e{0.5, 2, 0};
    for (const std::vector<Vec3>& points : {std::vector{a, a}, {a, b, c}, {a, b, a}, {a, b, c, e}, {a, b, d, d}, {a, a, a, a}}) {
        std::vector<Simplex::Corner> corners;
        for (const Vec3& point : points) {
            corners.push_back({point, point * 2});
        }
        expect_closest(corners);
    }
}

TEST(Simplex, TheOriginInsideIsTheClosestPoint) {
    for (const double turn : {1.0, -1.0}) { // of either orientation
        Simplex simplex;
        simplex.add({{turn, 0, 0}, {1, 0, 0}});
        simplex.add({{0, 1, 0}, {0, 1, 0}});
        simplex.add({{0, 0, 1}, {0, 0, 1}});
        simplex.add({{-turn, -1, -1}, {0, 0, 0}});
        EXPECT_EQ(simplex.closest(), Vec3());
        ASSERT_EQ(simplex.size, 4u);
        for (const double weight : simplex.weights) {
            EXPECT_NEAR(weight, 0.25, 1e-15);
        }
        EXPECT_LE(distance(simplex.in_first(), {0.25, 0.25, 0.25}), 1e-15);
    }
}

} // namespace
} // namespace foam
