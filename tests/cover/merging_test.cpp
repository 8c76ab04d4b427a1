// Fewer balls out of many.
#include "cover/expect_contained.hpp"
#include "search/src/by_spheres/moves/moves.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace foam;
using namespace foam::by_spheres;

constexpr std::size_t pieces = 2000, many = 24, fewest = 2;
constexpr int resolution = 32;

/// The skin and the inside of a solid, and many balls about it.
struct Example {
    explicit Example(const Solid& solid)
        : frame(solid.bounds()), skin(solid.surface(), frame, pieces), occupancy(solid, frame, resolution) {
        Random random(3);
        for (std::size_t i = 0; i < many; ++i) {
            const std::size_t p = random.below(skin.points.size());
            balls.push_back({skin.points.x[p], skin.points.y[p], skin.points.z[p], 0.3f});
        }
    }
    Frame frame;
    FineSurface skin;
    Occupancy occupancy;
    Balls balls;
};

class MergedSets : public testing::TestWithParam<std::string> {};

TEST_P(MergedSets, HaveOneBallFewerEachAndContainTheSurface) {
    const auto solid = sample::solids().at(GetParam())();
    const Example example(*solid);
    const std::vector<Balls> sets = merged_sets(example.skin, example.occupancy, example.balls, fewest);
    ASSERT_GT(sets.size(), many / 2);
    const std::size_t last = solid->parts().size(); // parts apart from each other are never merged
    for (std::size_t count = std::max(fewest, last); count < sets.size(); ++count) {
        ASSERT_EQ(sets[count].size(), count);
        ASSERT_NO_FATAL_FAILURE(test::expect_contained(example.skin, sets[count]));
    }
    for (std::size_t count = 0; count < fewest; ++count) {
        EXPECT_TRUE(sets[count].empty());
    }
}

INSTANTIATE_TEST_SUITE_P(Solids, MergedSets, testing::Values("Box", "Bracket", "TwoBoxes"));

/// Outside a solid and without other balls the volume is that of balls.
TEST(AddedVolume, IsTheDifferenceOfUnionsInTheOpen) {
    const Example example(*sample::solids().at("Box")());
    const Ball a{5, 0, 0, 1}, b{6.5, 0.2f, 0, 0.8f}, merged{5.7f, 0.1f, 0, 1.6f};
    const double difference = exact_union_volume(unit_spheres({merged})) - exact_union_volume(unit_spheres({a, b}));
    EXPECT_NEAR(added_volume(merged, a, b, {}, example.occupancy), difference, 0.03 * difference);
    EXPECT_NEAR(added_volume(merged, b, a, {}, example.occupancy), difference, 0.03 * difference);
}

TEST(AddedVolume, IsNoneWhereOthersOrTheSolidAre) {
    const auto solid = sample::solids().at("Box")();
    const Example example(*solid);
    const Ball a{5, 0, 0, 1}, b{6.5, 0, 0, 1}, merged{5.7f, 0, 0, 1.8f};
    EXPECT_EQ(added_volume(merged, a, b, {{5.7f, 0, 0, 4}}, example.occupancy), 0);
    const Ball small{0, 0, 0, 0.05f}, inside{0.05f, 0, 0, 0.05f}, both{0.025f, 0, 0, 0.1f};
    EXPECT_NEAR(added_volume(both, small, inside, {}, example.occupancy), 0, 1e-6);
}

} // namespace
