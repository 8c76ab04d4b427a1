// What spherize.grid and spherize.octree promise beyond the contract of all spherizers.
#include <foam/error.hpp>
#include <foam/host/contract.hpp>
#include <foam/host/registry.hpp>
#include <foam/measure.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace foam;

class GridAndOctree : public testing::TestWithParam<std::string> {
protected:
    GridAndOctree() {
        registry.load(FOAM_TEST_PLUGINS "/spherize_grid.so");
        registry.load(FOAM_TEST_PLUGINS "/spherize_octree.so");
    }

    SphereTree spherize(const std::shared_ptr<const Solid>& solid, const Budget& budget,
                        const std::map<std::string, ParameterValue>& parameters = {}) {
        return registry.make<Spherizer>(GetParam(), parameters)->spherize(Shape("part", solid, solid), budget, context);
    }

    Registry registry;
    QuietContext context;
};

double excess(const Solid& solid, const SphereTree& tree) {
    return union_volume(tree.finest()) / solid.volume() - 1;
}

TEST_P(GridAndOctree, CoverIsExactBeforeAnyGrowth) {
    for (const std::string name : {"Bracket", "Torus", "CylinderPrimitive", "OpenCup", "FarAway"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        for (const std::size_t count : {1, 8, 20}) {
            const std::vector<Sphere> spheres = spherize(solid, {count, {}, Guarantee::outer}).finest();
            const std::vector<Sphere> grown = grown_to_cover(*solid, spheres);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                EXPECT_LE(grown[i].radius - spheres[i].radius, 1e-6 * solid->bounds().diagonal());
            }
        }
    }
}

TEST_P(GridAndOctree, MoreSpheresNeverClaimMuchMore) {
    for (const std::string name : {"Bracket", "Torus", "CapsulePrimitive"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        double previous = std::numeric_limits<double>::infinity();
        for (const std::size_t count : {1, 2, 4, 8, 12, 20}) {
            const double now = excess(*solid, spherize(solid, {count, {}, Guarantee::outer}));
            EXPECT_LE(now, previous + 0.02) << count;
            previous = now;
        }
    }
}

TEST_P(GridAndOctree, AProtrusionLimitIsKept) {
    const auto solid = sample::solids().at("Bracket")();
    const double limit = 0.02;
    const SphereTree tree = spherize(solid, {{}, limit, Guarantee::outer});
    MeasureOptions options;
    options.surface_points = options.volume_points = 1'000;
    options.volume_rays = 300;
    EXPECT_LE(measure(*solid, grown_to_cover(*solid, tree.finest()), options).protrusion_max, 1.02 * limit);
    EXPECT_GT(tree.finest().size(), 1u);
    EXPECT_LE(spherize(solid, {5, limit / 100, Guarantee::outer}).finest().size(), 5u) << "the budget goes first";
}

TEST_P(GridAndOctree, DepthGivesLevelsWithParentsThatCoverTheirChildrensParts) {
    const auto solid = sample::solids().at("Bracket")();
    const SphereTree tree = spherize(solid, {}, {{"depth", std::int64_t{3}}});
    ASSERT_EQ(tree.levels.size(), 4u);
    for (std::size_t l = 1; l < tree.levels.size(); ++l) {
        EXPECT_GT(tree.levels[l].spheres.size(), tree.levels[l - 1].spheres.size());
        for (std::size_t i = 0; i < tree.levels[l].spheres.size(); ++i) {
            // A child's ball holds a part of what its parent's holds: the two meet, and the child is no larger.
            const Sphere& child = tree.levels[l].spheres[i];
            const Sphere& parent = tree.levels[l - 1].spheres[tree.levels[l].parents[i]];
            EXPECT_LE(distance(child.center, parent.center), parent.radius * 1.000001);
            EXPECT_LE(child.radius, parent.radius * 1.000001);
        }
    }
}

TEST_P(GridAndOctree, SurfaceAloneLeavesTheInsideOut) {
    const auto solid = Solid::make(sample::box({1, 1, 1}));
    const Budget budget{64, {}, Guarantee::outer};
    const auto holds_center = [](const SphereTree& tree) {
        return std::any_of(tree.finest().begin(), tree.finest().end(), [](const Sphere& s) {
            return distance(s.center, {0.01, 0.02, 0.03}) <= s.radius;
        });
    };
    EXPECT_TRUE(holds_center(spherize(solid, budget)));
    EXPECT_LE(spherize(solid, budget, {{"content", std::string("surface")}}).finest().size(), 64u);
}

TEST_P(GridAndOctree, InnerSpheresStayInside) {
    for (const std::string name : {"Box", "Bracket", "CapsulePrimitive"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        for (const std::size_t count : {1, 8, 20}) {
            const SphereTree tree = spherize(solid, {count, {}, Guarantee::inner});
            EXPECT_LE(tree.finest().size(), count);
            for (const Sphere& sphere : tree.finest()) {
                EXPECT_GT(sphere.radius, 0);
                EXPECT_LE(sphere.radius, -solid->signed_distance(sphere.center));
            }
        }
    }
}

TEST_P(GridAndOctree, AFlatPartHasNoInnerSpheres) {
    try {
        spherize(sample::solids().at("FlatSquare")(), {4, {}, Guarantee::inner});
        FAIL() << "a flat square has no interior";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        EXPECT_THAT(error.what(), testing::HasSubstr("part has no interior"));
    }
}

INSTANTIATE_TEST_SUITE_P(Stages, GridAndOctree, testing::Values("spherize.grid", "spherize.octree"),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

class Grid : public GridAndOctree {};

TEST_P(Grid, ABarGetsCubes) {
    // 1 × 1 × 4: four cubes, each in its circumscribed ball.
    const auto solid = Solid::make(sample::box({0.1, 0.1, 0.4}));
    const SphereTree tree = spherize(solid, {4, {}, Guarantee::outer});
    ASSERT_EQ(tree.finest().size(), 4u);
    for (const Sphere& sphere : tree.finest()) {
        EXPECT_NEAR(sphere.radius, 0.05 * std::sqrt(3.0), 1e-5);
    }
}

TEST_P(Grid, ARotatedPartCostsTheSame) {
    const Mesh upright = sample::box({0.1, 0.1, 0.4});
    const auto solid = Solid::make(upright);
    const auto turned = Solid::make(transformed(upright, Pose::from_xyz_rpy({1, 2, 3}, {0.4, 0.7, 0.2})));
    const Budget budget{4, {}, Guarantee::outer};
    EXPECT_NEAR(excess(*turned, spherize(turned, budget)), excess(*solid, spherize(solid, budget)), 0.02);
}

TEST_P(Grid, WithoutRefinementAGridAlone) {
    const auto solid = Solid::make(sample::box({0.2, 0.2, 0.4}));
    const auto count = [&](std::size_t most, bool refine) {
        return spherize(solid, {most, {}, Guarantee::outer}, {{"refine", refine}}).finest().size();
    };
    EXPECT_EQ(count(3, true), 3u);
    EXPECT_LE(count(17, false), 17u);
}

INSTANTIATE_TEST_SUITE_P(Stages, Grid, testing::Values("spherize.grid"), [](const auto&) { return "grid"; });

} // namespace
