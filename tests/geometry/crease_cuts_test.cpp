// Triangles and prisms cut where balls meet: nothing of them may be left out, and no more rounding than was allowed
// for.
#include "geometry/shapes.hpp"
#include "geometry/src/proof/crease_cuts.hpp"

#include <gtest/gtest.h>

#include <numeric>

using namespace foam;
using namespace foam::test;
using geometry::Balls;
using geometry::CreaseCuts;
using geometry::Piece;

namespace {

std::vector<std::uint32_t> all_of(const Balls& balls) {
    std::vector<std::uint32_t> indices(balls.size());
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

/// The triangle (0,0,0) (count,0,0) (0,1,0) under a row of balls that meet above x = 1, 2, ….
struct Row {
    explicit Row(int count, std::uint32_t most_halvings = 120)
        : solid(Solid::make(triangle({0, 0, 0}, {double(count), 0, 0}, {0, 1, 0}))),
          balls(*solid, row_of_balls(count, 1.2), 120), cuts(balls, most_halvings) {}

    bool covered() { return cuts.cover(balls.piece(0), all_of(balls)); }

    std::shared_ptr<const Solid> solid;
    Balls balls;
    CreaseCuts cuts;
};

} // namespace

TEST(CreaseCuts, EachCutCountsAsTwoHalvings) {
    for (std::uint32_t most = 0; most < 6; ++most) {
        Row two(2, most);
        EXPECT_EQ(two.covered(), most >= 2) << most;
    }
    Row enough(5);
    ASSERT_TRUE(enough.covered());
    const std::uint32_t needed = 2 * enough.cuts.most_cuts();
    EXPECT_TRUE(Row(5, needed).covered());
    EXPECT_FALSE(Row(5, needed - 1).covered());
}

TEST(CreaseCuts, WhatIsBeneathIsAskedFor) {
    // A prism under two balls: its top lies in them, of what is beneath one corner at a time does not.
    const auto solid = Solid::make(triangle({-1, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    Piece piece{.corners = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .beneath = {{-1, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}}};
    piece.curved = true;
    const Balls balls(*solid, std::vector<Sphere>{{{-0.7, 0.1, 0.5}, 1.6}, {{0.7, 0.1, 0.5}, 1.6}}, 120);
    const Vec3 origin = balls.to_solid({});
    const auto moved = [&](Piece p) {
        for (geometry::Corners* t : {&p.corners, &p.beneath}) {
            for (Vec3* v : {&t->a, &t->b, &t->c}) {
                *v = *v - origin;
            }
        }
        return p;
    };
    CreaseCuts cuts(balls, 120);
    EXPECT_TRUE(cuts.cover(moved(piece), all_of(balls)));
    EXPECT_GT(cuts.pieces(), 0u);
    std::vector<double> shallow(2, 0);
    cuts.raise(moved(piece), all_of(balls), shallow);
    EXPECT_EQ(shallow, (std::vector<double>{0, 0})) << "nothing is open";
    for (Vec3 geometry::Corners::*corner : {&geometry::Corners::a, &geometry::Corners::b, &geometry::Corners::c}) {
        Piece deep = piece;
        deep.beneath.*corner = piece.beneath.*corner - Vec3{0, 0, 2};
        EXPECT_FALSE(cuts.cover(moved(deep), all_of(balls)));
        std::vector<double> reach(2, 0);
        cuts.raise(moved(deep), all_of(balls), reach);
        const double needed =
            std::min(distance(deep.beneath.*corner, {-0.7, 0.1, 0.5}), distance(deep.beneath.*corner, {0.7, 0.1, 0.5}));
        EXPECT_NEAR(std::max(reach[0], reach[1]), needed, 1e-12) << "as far as the deepest corner";
        deep.curved = false;
        EXPECT_TRUE(cuts.cover(moved(deep), all_of(balls))) << "of a flat piece nothing is beneath";
    }
}

TEST(CreaseCuts, RaisedBallsHoldTheTriangle) {
    // Each ball takes its part, and no more: the distance to the farthest corner of its power cell.
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const auto point = [&] { return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
        const auto solid = Solid::make(triangle(point(), point(), point()));
        std::vector<Sphere> spheres;
        for (int i = round % 6; i >= 0; --i) {
            spheres.push_back({point(), random.uniform(0.1, 0.5)});
        }
        const Balls balls(*solid, spheres, 120);
        CreaseCuts cuts(balls, 120);
        std::vector<double> reach(spheres.size(), 0), sampled(spheres.size(), 0);
        cuts.raise(balls.piece(0), all_of(balls), reach);
        const geometry::Corners t = balls.piece(0).corners;
        constexpr int steps = 60;
        for (int a = 0; a <= steps; ++a) {
            for (int b = 0; a + b <= steps; ++b) {
                const Vec3 p = t.a + (t.b - t.a) * (a / double(steps)) + (t.c - t.a) * (b / double(steps));
                std::size_t owner = 0;
                for (std::uint32_t i = 0; i < spheres.size(); ++i) {
                    owner = balls.power(i, p) < balls.power(static_cast<std::uint32_t>(owner), p) ? i : owner;
                }
                const double away = distance(p, balls.center(static_cast<std::uint32_t>(owner)));
                sampled[owner] = std::max(sampled[owner], away);
                EXPECT_TRUE(away <= std::max(reach[owner], spheres[owner].radius) + 1e-12) << round;
            }
        }
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            EXPECT_LE(reach[i], sampled[i] + 0.1)
                << "no farther than its part reaches, but for the samples' spacing; " << round;
        }
    }
}
