// The parts of a surface that belong to balls.
#include "search/src/by_spheres/descent/descent.hpp"
#include "search/src/by_spheres/starts/power_cells.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace foam;
using namespace foam::by_spheres;

Balls balls_at_random(std::size_t count, Random& random) {
    const auto between = [&](double low, double high) {
        return static_cast<float>(low + (high - low) * random.uniform());
    };
    Balls balls;
    for (std::size_t i = 0; i < count; ++i) {
        balls.push_back({between(-1, 1), between(-1, 1), between(-1, 1), between(0.2, 0.8)});
    }
    return balls;
}

/// How far points reach in a direction.
double reach(const Points& points, const Vec3& direction) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t p = 0; p < points.size(); ++p) {
        most = std::max(most, dot(points.at(p), direction));
    }
    return most;
}

class PartsOfSolid : public testing::TestWithParam<std::string> {};

/// Parts have few points. Their hulls still contain all points of the surface that the balls own.
TEST_P(PartsOfSolid, HullsContainAllPointsOfTheCells) {
    constexpr std::size_t pieces = 2000;
    const auto solid = sample::solids().at(GetParam())();
    const Frame frame(solid->bounds());
    const FineSurface skin(solid->surface(), frame, pieces);
    ASSERT_TRUE(skin.fine);
    ASSERT_LT(skin.middles_begin, skin.middles_end);
    ASSERT_EQ(skin.middles_end, skin.points.size());
    Random random(7);
    for (const std::size_t count : {1, 2, 5, 12}) {
        const Balls balls = balls_at_random(count, random);
        Owners owners;
        owners.find(skin.points, balls);
        PowerCells cells(skin);
        const Balls sharers = cells.shared(balls);
        std::size_t given = 0;
        for (std::size_t i = 0; i < sharers.size(); ++i) {
            const auto ball = std::find(balls.begin(), balls.end(), sharers[i]) - balls.begin();
            Points owned;
            for (std::size_t p = 0; p < skin.points.size(); ++p) {
                if (owners.owner[p] == static_cast<std::uint32_t>(ball)) {
                    owned.add(skin.points, p);
                }
            }
            for (const Vec3& direction : geometry::fibonacci_directions(200)) {
                EXPECT_LE(reach(owned, direction), reach(cells.parts()[i], direction) + 1e-6) << count << " balls";
            }
            given += cells.parts()[i].size();
        }
        EXPECT_LT(given, skin.points.size() / 2) << count << " balls";
    }
}

/// A few large triangles take as many pieces as the balls need.
TEST(FineSurface, IsFineForThousandsOfBalls) {
    const auto solid = sample::solids().at("Box")();
    for (const std::size_t balls : {1, 64, 1500, 5000}) {
        const DescentSurface surface(*solid, Frame(solid->bounds()), balls);
        EXPECT_TRUE(surface.skin.fine) << balls << " balls";
        EXPECT_GT(surface.skin.faces.size(), DescentSurface::pieces_for(balls) / 2) << balls << " balls";
    }
}

TEST(Owners, AreTheSameUpdatedAsFoundAnew) {
    Random random(9);
    Points points;
    for (const Ball& ball : balls_at_random(500, random)) {
        points.add(center_of(ball));
    }
    Balls balls = balls_at_random(40, random);
    Owners updated, anew;
    updated.find(points, balls);
    for (int turn = 0; turn < 30; ++turn) {
        const std::size_t one = random.below(balls.size());
        std::size_t other = random.below(balls.size());
        const Balls fresh = balls_at_random(2, random);
        if (turn % 2 == 0 || other == one) { // a split
            other = balls.size();
            balls.emplace_back();
        }
        balls[one] = fresh[0];
        balls[other] = fresh[1];
        const std::vector<std::uint32_t> before = updated.owner;
        std::vector<std::uint32_t> changed = updated.update(points, balls, one, other);
        anew.find(points, balls);
        ASSERT_EQ(updated.owner, anew.owner);
        ASSERT_EQ(updated.power, anew.power);
        std::ranges::sort(changed);
        std::vector<std::uint32_t> theirs;
        for (std::uint32_t p = 0; p < points.size(); ++p) {
            const auto is_theirs = [&](std::uint32_t owner) { return owner == one || owner == other; };
            if (is_theirs(before[p]) || is_theirs(anew.owner[p])) {
                theirs.push_back(p);
            }
        }
        ASSERT_EQ(changed, theirs);
    }
}

INSTANTIATE_TEST_SUITE_P(Solids, PartsOfSolid, testing::Values("Box", "Bracket", "TwoBoxes"));

} // namespace
