// The rim of an open surface, and how far the bound on the winding number near it reaches.
#include "geometry/shapes.hpp"
#include "geometry/src/proof/rim.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

struct RimEdge {
    Vec3 from, to;
    int times;
};

/// The largest radius that the rim's bound allows, from its definition: edges are cut to 1/64 of the extent, and each
/// piece counts with its nearest point.
double radius_by_definition(const std::vector<RimEdge>& edges, double extent, const Vec3& p, double winding,
                            double free) {
    struct Piece {
        long double length, distance;
    };
    std::vector<Piece> pieces;
    long double nearest = free;
    for (const RimEdge& e : edges) {
        const int count = static_cast<int>(std::ceil(distance(e.from, e.to) / (extent / 64)));
        const Vec3 step = (e.to - e.from) / count;
        for (int k = 0; k < count; ++k) {
            const Vec3 a = e.from + step * k, way = p - a;
            const double along = std::clamp(dot(way, step) / squared_norm(step), 0.0, 1.0);
            pieces.push_back({std::abs(e.times) * static_cast<long double>(norm(step)), norm(way - step * along)});
            nearest = std::min(nearest, pieces.back().distance);
        }
    }
    long double low = 0, high = nearest;
    for (int step = 0; step < 100; ++step) {
        const long double r = (low + high) / 2;
        long double fall = 0;
        for (const Piece& piece : pieces) {
            fall += piece.length * (1 / (piece.distance - r) - 1 / piece.distance);
        }
        (fall / (4 * std::numbers::pi_v<long double>) < winding - 0.5L ? low : high) = r;
    }
    return static_cast<double>(low);
}

double extent_of(const std::vector<geometry::Corners>& triangles) {
    Box box;
    for (const geometry::Corners& t : triangles) {
        for (const Vec3& corner : {t.a, t.b, t.c}) {
            box.add(corner);
        }
    }
    return box.diagonal();
}

} // namespace

TEST(Rim, TheRadiusIsThatOfTheBound) {
    Random random(31);
    std::size_t freely = 0, held_back = 0;
    for (int round = 0; round < 200; ++round) {
        const double size = std::pow(10, random.uniform(-3, 3));
        const auto point = [&] { return random_point(random, {{-size, -size, -size}, {size, size, size}}); };
        const double near = round % 2 == 0 ? 1 : 0.01; // an edge too short to be cut
        const Vec3 a = point(), b = point(), c = a + near * (point() - a), d = point(), p = a + near * (point() - a);
        // What rims two triangles have: as neighbours wound alike and against each other, the same one twice.
        const std::vector<std::pair<std::vector<geometry::Corners>, std::vector<RimEdge>>> cases{
            {{{a, b, c}}, {{a, b, 1}, {b, c, 1}, {c, a, 1}}},
            {{{a, b, c}, {a, c, d}}, {{a, b, 1}, {b, c, 1}, {c, d, 1}, {d, a, 1}}},
            {{{a, b, c}, {c, a, d}}, {{a, b, 1}, {b, c, 1}, {c, a, 2}, {a, d, 1}, {d, c, 1}}},
            {{{a, b, c}, {b, c, a}}, {{a, b, 2}, {b, c, 2}, {c, a, 2}}},
            {{{a, b, c}, {a, b, b}}, {{a, b, 1}, {b, c, 1}, {c, a, 1}}}};
        const auto& [triangles, edges] = cases[static_cast<std::size_t>(round) % cases.size()];
        const geometry::Rim rim(triangles);
        const double winding = random.uniform(0.5, 3), free = size * random.uniform(0.01, 2);
        const double expected = radius_by_definition(edges, extent_of(triangles), p, winding, free);
        const double radius = rim.radius_above_half(p, winding, free);
        EXPECT_NEAR(radius, expected, 1e-10 * expected) << round;
        EXPECT_TRUE(radius == free || radius <= expected) << round;
        (radius == free ? freely : held_back) += 1;
    }
    EXPECT_GT(freely, 20u);
    EXPECT_GT(held_back, 50u);
}

TEST(Rim, WithoutARimAllIsFreeWhereTheWindingIsAboveHalf) {
    const std::vector<geometry::Corners> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const std::vector<geometry::Corners> both_ways{one[0], {{0, 0, -0.0}, {0, 1, 0}, {1, 0, 0}}};
    for (const geometry::Rim& none : {geometry::Rim(), geometry::Rim(both_ways)}) {
        EXPECT_TRUE(none.empty());
        EXPECT_EQ(none.radius_above_half({0, 0, 1}, 0.51, 3), 3);
        EXPECT_EQ(none.radius_above_half({0, 0, 1}, 0.5, 3), 0);
        EXPECT_EQ(none.radius_above_half({0, 0, 1}, 0.3, 3), 0);
        EXPECT_EQ(none.radius_above_half({0, 0, 1}, std::nan(""), 3), 0);
    }
    const geometry::Rim rim(one);
    EXPECT_FALSE(rim.empty());
    EXPECT_EQ(rim.radius_above_half({0, 0, 1}, 0.5, 3), 0);
}

TEST(Rim, ARimTooShortForALengthStillHoldsBack) {
    // Its edges' squared lengths are below the smallest number: what is left of them is a point.
    const double tiny = 1e-200;
    const geometry::Rim rim(std::vector<geometry::Corners>{{{0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}}});
    EXPECT_FALSE(rim.empty());
    const double radius = rim.radius_above_half({0, 0, 0.25}, 0.9, 3);
    EXPECT_LE(radius, 0.25 * (1 - 1e-12)) << "with room for rounding";
    EXPECT_GE(radius, 0.25 * (1 - 1e-11));
}
