// What spherize.grid, spherize.octree and spherize.voxel promise beyond the contract of all spherizers.
#include <foam/base/error.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/sdk/registry.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace {

using namespace foam;

class Cells : public testing::TestWithParam<std::string> {
protected:
    Cells() {
        registry.load(FOAM_TEST_PLUGINS "/spherize_grid.so");
        registry.load(FOAM_TEST_PLUGINS "/spherize_octree.so");
        registry.load(FOAM_TEST_PLUGINS "/spherize_voxel.so");
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

TEST_P(Cells, CoverIsExactBeforeAnyGrowth) {
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

TEST_P(Cells, MoreSpheresNeverClaimMuchMore) {
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

TEST_P(Cells, AProtrusionLimitIsKept) {
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

TEST_P(Cells, SurfaceAloneLeavesTheInsideOut) {
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

TEST_P(Cells, InnerSpheresStayInside) {
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

TEST_P(Cells, AFlatPartHasNoInnerSpheres) {
    try {
        spherize(sample::solids().at("FlatSquare")(), {4, {}, Guarantee::inner});
        FAIL() << "a flat square has no interior";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        EXPECT_THAT(error.what(), testing::HasSubstr("part has no interior"));
    }
}

std::string method(const testing::TestParamInfo<std::string>& test) {
    return test.param.substr(test.param.find('.') + 1);
}

INSTANTIATE_TEST_SUITE_P(Stages, Cells, testing::Values("spherize.grid", "spherize.octree", "spherize.voxel"), method);

class Depth : public Cells {};

TEST_P(Depth, DepthGivesLevelsWithParentsThatCoverTheirChildrensParts) {
    const auto solid = sample::solids().at("Bracket")();
    const SphereTree tree = spherize(solid, {}, {{"depth", std::int64_t{3}}});
    ASSERT_EQ(tree.levels.size(), 4u);
    for (std::size_t l = 1; l < tree.levels.size(); ++l) {
        EXPECT_GT(tree.levels[l].elements.spheres().size(), tree.levels[l - 1].elements.spheres().size());
        for (std::size_t i = 0; i < tree.levels[l].elements.spheres().size(); ++i) {
            // A child's ball holds a part of what its parent's holds: the two meet, and the child is no larger.
            const Sphere& child = tree.levels[l].elements.spheres()[i];
            const Sphere& parent = tree.levels[l - 1].elements.spheres()[tree.levels[l].parents[i]];
            EXPECT_LE(distance(child.center, parent.center), parent.radius * 1.000001);
            EXPECT_LE(child.radius, parent.radius * 1.000001);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Stages, Depth, testing::Values("spherize.grid", "spherize.octree"), method);

class Grid : public Cells {};

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

INSTANTIATE_TEST_SUITE_P(Stages, Grid, testing::Values("spherize.grid"), method);

class OctreeStage : public Cells {};

TEST_P(OctreeStage, ARingIsNotLeftInOneSphere) {
    // No single split of the first cube saves volume: eight balls around a ring claim more than one.
    const auto solid = sample::solids().at("Torus")();
    EXPECT_LT(excess(*solid, spherize(solid, {32, {}, Guarantee::outer})),
              0.9 * excess(*solid, spherize(solid, {1, {}, Guarantee::outer})));
}

INSTANTIATE_TEST_SUITE_P(Stages, OctreeStage, testing::Values("spherize.octree"), method);

class Voxel : public Cells {};

TEST_P(Voxel, SpheresOfTheRadiusThatIsAskedFor) {
    const auto solid = Solid::make(sample::box({0.2, 0.4, 0.6}));
    const SphereTree tree = spherize(solid, {}, {{"radius", 0.1}, {"spacing", 1.0}});
    ASSERT_EQ(tree.finest().size(), 2u * 4 * 6);
    for (const Sphere& sphere : tree.finest()) {
        EXPECT_EQ(sphere.radius, 0.1);
        for (const double coordinate : {sphere.center.x, sphere.center.y, sphere.center.z}) {
            EXPECT_NEAR(std::remainder(coordinate - 0.05, 0.1), 0, 1e-9) << "not on the lattice";
        }
    }
}

TEST_P(Voxel, ANumberIsUsedByTheRadiusThatClaimsLeast) {
    const auto solid = sample::solids().at("Bracket")();
    const SphereTree few = spherize(solid, {30, {}, Guarantee::outer}),
                     many = spherize(solid, {200, {}, Guarantee::outer});
    for (const SphereTree& tree : {few, many}) {
        EXPECT_GT(tree.finest().size(), 10u);
        for (const Sphere& sphere : tree.finest()) {
            EXPECT_EQ(sphere.radius, tree.finest()[0].radius);
        }
    }
    EXPECT_LT(many.finest()[0].radius, few.finest()[0].radius);
    EXPECT_LT(excess(*solid, many), excess(*solid, few));
}

TEST_P(Voxel, WhereTheRadiusTakesTooManyLargerOnesAreTakenAndThisIsSaid) {
    class Listening final : public QuietContext {
    public:
        void log(Severity, std::string_view message) override { said += message; }
        std::string said;
    };
    Listening listening;
    const auto solid = Solid::make(sample::box({0.2, 0.4, 0.6}));
    const auto stage = registry.make<Spherizer>("spherize.voxel", {{"radius", 0.001}, {"most", std::int64_t{100}}});
    const SphereTree tree = stage->spherize({"part", solid, solid}, {}, listening);
    EXPECT_LE(tree.finest().size(), 100u);
    EXPECT_GT(tree.finest().size(), 20u);
    EXPECT_EQ(listening.said, "part: spheres of the radius asked for are more than 100 here, larger ones are taken; "
                              "remedy: raise radius or most");
}

TEST_P(Voxel, WideSpacingLeavesGapsForGrowthToClose) {
    const auto solid = sample::solids().at("Bracket")();
    const auto growth = [&](double spacing) {
        const std::vector<Sphere> spheres = spherize(solid, {}, {{"radius", 0.02}, {"spacing", spacing}}).finest();
        const std::vector<Sphere> grown = grown_to_cover(*solid, spheres);
        double most = 0;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            most = std::max(most, grown[i].radius - spheres[i].radius);
        }
        return most;
    };
    EXPECT_LT(growth(1.15), 1e-6);
    EXPECT_GT(growth(1.8), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Stages, Voxel, testing::Values("spherize.voxel"), method);

} // namespace
