// Points and pieces of a surface that balls leave open.
#include "search/src/by_spheres/moves/remainder.hpp"
#include "search/src/by_spheres/starts/starts.hpp"

#include <foam/base/random.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace foam;
using by_spheres::SurfacePiece, by_spheres::PieceCorner;

constexpr float finest = 0.03f;

/// A square of side 2 about the origin, as two triangles.
const std::vector<SurfacePiece>& square() {
    constexpr PieceCorner a{-1, -1, 0}, b{1, -1, 0}, c{1, 1, 0}, d{-1, 1, 0};
    static const std::vector<SurfacePiece> triangles{{0, {a, b, c}}, {7, {a, c, d}}};
    return triangles;
}

float between(const PieceCorner& a, const PieceCorner& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Whether a point lies no farther from a piece than rounding.
bool lies_in(const SurfacePiece& piece, float x, float y) {
    const auto turn = [&](const PieceCorner& a, const PieceCorner& b) {
        return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    };
    const auto& [a, b, c] = piece.corners;
    const float ab = turn(a, b), bc = turn(b, c), ca = turn(c, a);
    constexpr float rounding = 1e-6f;
    return std::min({ab, bc, ca}) > -rounding || std::max({ab, bc, ca}) < rounding;
}

class BallsOverASquare : public testing::TestWithParam<std::size_t> {};

TEST_P(BallsOverASquare, LeaveSmallPiecesOpenThatContainAllThatIsInNoBall) {
    Random random(GetParam());
    const auto coordinate = [&] { return static_cast<float>(2 * random.uniform() - 1); };
    const float radius = 1.5f / std::sqrt(static_cast<float>(GetParam()));
    by_spheres::Balls balls;
    for (std::size_t i = 0; i < GetParam(); ++i) {
        const float x = coordinate(), y = coordinate();
        balls.push_back({x, y, 0.1f * radius * coordinate(), radius});
    }
    const auto open = by_spheres::open_pieces(square(), balls, finest, 1'000'000);
    ASSERT_TRUE(open);
    for (const SurfacePiece& piece : *open) {
        const auto& [a, b, c] = piece.corners;
        EXPECT_LE(std::max({between(a, b), between(b, c), between(c, a)}), finest);
        EXPECT_TRUE(piece.triangle == 0 || piece.triangle == 7);
    }
    EXPECT_TRUE(std::ranges::is_sorted(*open, {}, &SurfacePiece::triangle));
    int in_none = 0;
    for (int i = 0; i < 2000; ++i) {
        const float x = coordinate(), y = coordinate();
        if (std::ranges::none_of(balls,
                                 [&](const by_spheres::Ball& b) { return b.squared_distance(x, y, 0) <= b.r * b.r; })) {
            ++in_none;
            EXPECT_TRUE(std::ranges::any_of(*open, [&](const SurfacePiece& piece) { return lies_in(piece, x, y); }));
        }
    }
    EXPECT_GT(in_none, 0);
    EXPECT_FALSE(by_spheres::open_pieces(square(), balls, finest, open->size() - 1)) << "more than are allowed";
}

// One block of eight balls, a few, and more than one look takes.
INSTANTIATE_TEST_SUITE_P(Numbers, BallsOverASquare, testing::Values(1, 3, 20, 100, 400));

TEST(OpenPieces, AreNoneInOneBallOrInTwoThatOverlapWidely) {
    EXPECT_TRUE(by_spheres::open_pieces(square(), {{0, 0, 0, 1.5f}}, finest, 100)->empty());
    EXPECT_TRUE(by_spheres::open_pieces(square(), {{-0.5f, 0, 0, 1.3f}, {0.5f, 0, 0, 1.3f}}, finest, 100)->empty());
    EXPECT_GT(by_spheres::open_pieces(square(), {}, finest, 100'000)->size(), 4 / (finest * finest));
}

// Hundreds of spheres once began with balls of no size, and ended with the machine's memory.
TEST(CreasePoints, StayFewWhereTinyBallsLeaveNearlyAllOpen) {
    const auto box = Solid::make(sample::box({0.2, 0.2, 0.2}));
    const by_spheres::Frame frame(box->bounds());
    const by_spheres::Balls balls{{0, 0, 0, 1e-5f}, {0.1f, 0, 0, 1e-5f}};
    const by_spheres::Points points = by_spheres::crease_points(*box, frame, balls, 1e-5, 500);
    EXPECT_EQ(points.size(), 500u);
    double reach = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        reach = std::max(reach, points.at(i).z);
    }
    EXPECT_GT(reach, 0.55) << "they are to lie all over the surface";
}

} // namespace
