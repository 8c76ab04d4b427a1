// Cells: pieces of a solid in boxes, and the balls around them.
#include <foam/base/random.hpp>
#include <foam/geometry/cell.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

const std::array<Vec3, 3> frame{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

std::vector<Sphere> balls(const std::vector<Cell>& cells) {
    std::vector<Sphere> result;
    for (const Cell& cell : cells) {
        result.push_back(cell.ball());
    }
    return result;
}

bool covered(const std::vector<Sphere>& spheres, const Vec3& point, double slack) {
    for (const Sphere& sphere : spheres) {
        if (distance(point, sphere.center) <= sphere.radius + slack) {
            return true;
        }
    }
    return false;
}

TEST(Cell, ABoxDividedEvenlyGivesCircumscribedBalls) {
    const auto solid = Solid::make(sample::box({0.2, 0.4, 0.6}));
    const std::vector<Cell> cells = Cell::whole(*solid, frame, Cell::Content::solid).divided({1, 2, 3});
    ASSERT_EQ(cells.size(), 6u);
    for (const Sphere& ball : balls(cells)) {
        EXPECT_NEAR(ball.radius, 0.1 * std::sqrt(3.0), 1e-5);
    }
}

TEST(Cell, InteriorCellsCountOnlyWhenTheSolidDoes) {
    const auto solid = Solid::make(sample::box({1, 1, 1}));
    EXPECT_EQ(Cell::whole(*solid, frame, Cell::Content::solid).divided({3, 3, 3}).size(), 27u);
    EXPECT_EQ(Cell::whole(*solid, frame, Cell::Content::surface).divided({3, 3, 3}).size(), 26u);
}

TEST(Cell, FacesBetweenCellsBelongToTheSideOfTheSolid) {
    // The planes of the division run along the bracket's inner faces: the empty quarter must stay empty.
    const auto solid = Solid::make(sample::bracket());
    const std::vector<Cell> cells = Cell::whole(*solid, frame, Cell::Content::solid).divided({4, 1, 3});
    EXPECT_EQ(cells.size(), 6u);
    for (const Cell& cell : cells) {
        EXPECT_NEAR(cell.ball().radius, std::sqrt(0.05 * 0.05 + 0.1 * 0.1 + 0.05 * 0.05) / 2, 1e-5);
    }
}

TEST(Cell, BallsCoverSurfaceAndInterior) {
    Random random(11);
    for (const std::string name :
         {"Torus", "Bracket", "CylinderPrimitive", "TwoBoxes", "OverlappingParts", "FarAway"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        const double size = solid->bounds().diagonal();
        for (int turn = 0; turn < 4; ++turn) {
            const Pose pose =
                Pose::from_xyz_rpy({}, {random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)});
            const Cell whole = Cell::whole(*solid, pose.rotation, Cell::Content::solid);
            const std::vector<Sphere> spheres = balls(whole.divided({2 + turn, 3, 4}));
            for (const SurfacePoint& sample : solid->sample_surface(500, 1)) {
                EXPECT_TRUE(covered(spheres, sample.point, 1e-9 * size));
            }
            const Box box = solid->bounds();
            for (int i = 0; i < 500; ++i) {
                const Vec3 point{random.uniform(box.low.x, box.high.x), random.uniform(box.low.y, box.high.y),
                                 random.uniform(box.low.z, box.high.z)};
                EXPECT_TRUE(!solid->contains(point) || covered(spheres, point, 1e-9 * size));
            }
        }
    }
}

TEST(Cell, BallsAreProvedWithNextToNoGrowth) {
    for (const auto& [name, make] : sample::solids()) {
        SCOPED_TRACE(name);
        const auto solid = as_surface(*make()); // cells of the surface leave the middle empty
        const std::vector<Sphere> spheres =
            balls(Cell::whole(*solid, principal_axes(*solid), Cell::Content::surface).divided({3, 2, 2}));
        const std::vector<Sphere> grown = grown_to_cover(*solid, spheres);
        ASSERT_TRUE(certify(*solid, grown).holds);
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            EXPECT_LE(grown[i].radius - spheres[i].radius, 1e-6 * solid->bounds().diagonal());
        }
    }
}

TEST(Cell, CoarseCellsAreAboutTheSame) {
    const auto solid = Solid::make(sample::torus(0.1, 0.03, 200, 100));
    const Cell whole = Cell::whole(*solid, frame, Cell::Content::solid);
    const Cell coarse = whole.coarse(0.005);
    EXPECT_LT(coarse.pieces(), whole.pieces() / 5);
    const std::vector<Cell> fine_cells = whole.divided({3, 3, 1}), coarse_cells = coarse.divided({3, 3, 1});
    ASSERT_EQ(fine_cells.size(), coarse_cells.size());
    for (std::size_t i = 0; i < fine_cells.size(); ++i) {
        EXPECT_NEAR(fine_cells[i].ball().radius, coarse_cells[i].ball().radius, 0.01);
    }
}

TEST(Cell, TurnedIsWholeAlongOtherAxes) {
    const auto solid = sample::solids().at("Bracket")();
    const Pose pose = Pose::from_xyz_rpy({}, {0.3, 0.5, 0.7});
    const Cell turned = Cell::whole(*solid, frame, Cell::Content::solid).turned(pose.rotation);
    const Cell direct = Cell::whole(*solid, pose.rotation, Cell::Content::solid);
    EXPECT_LT(norm(turned.box().low - direct.box().low), 1e-12);
    EXPECT_LT(norm(turned.box().high - direct.box().high), 1e-12);
}

TEST(Cell, InnerBallsLieInside) {
    const auto solid = Solid::make(sample::box({1, 1, 1}));
    const Cell whole = Cell::whole(*solid, frame, Cell::Content::solid);
    ASSERT_TRUE(whole.inner_ball());
    EXPECT_NEAR(whole.inner_ball()->radius, 0.5, 1e-6);
    EXPECT_LE(whole.inner_ball()->radius, 0.5);
    const auto flat = sample::solids().at("FlatSquare")();
    EXPECT_FALSE(Cell::whole(*flat, frame, Cell::Content::surface).inner_ball());
}

TEST(VolumeSaved, MatchesTheVolumes) {
    const std::vector<Sphere> one{{{0, 0, 0}, 1}};
    const std::vector<Sphere> halves{{{0.5, 0, 0}, 0.4}, {{-0.5, 0, 0}, 0.4}};
    const double unit = 4.0 / 3.0 * std::numbers::pi;
    EXPECT_NEAR(volume_saved(one, 0, halves), unit * (1 - 2 * 0.4 * 0.4 * 0.4), 0.1 * unit);
    EXPECT_NEAR(volume_saved(one, 0, one), 0, 1e-12);
    const std::vector<Sphere> outside{{{5, 0, 0}, 2}};
    EXPECT_NEAR(volume_saved(one, 0, outside), -7 * unit, 1e-9);
    // Under another ball nothing is saved.
    EXPECT_EQ(volume_saved(std::vector<Sphere>{{{0, 0, 0}, 1}, {{0, 0, 0}, 2}}, 0, halves), 0);
}

TEST(PrincipalAxes, OfABox) {
    const Pose pose = Pose::from_xyz_rpy({1, 2, 3}, {0.3, 0.5, 0.7});
    const auto solid = Solid::make(transformed(sample::box({3, 2, 1}), pose));
    const auto axes = principal_axes(*solid);
    for (int i = 0; i < 3; ++i) {
        Vec3 axis{};
        axis[i] = 1;
        EXPECT_NEAR(std::abs(dot(axes[static_cast<std::size_t>(i)], pose.rotate(axis))), 1, 1e-9);
    }
    EXPECT_NEAR(dot(cross(axes[0], axes[1]), axes[2]), 1, 1e-12);
}

} // namespace
