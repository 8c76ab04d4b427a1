// Walks every registered spherizer over solids of many kinds: what stage.hpp promises holds for each.
#include "solids.hpp"

#include <foam/error.hpp>
#include <foam/host/registry.hpp>
#include <foam/measure.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace {

using namespace foam;

const std::vector<std::size_t> counts{1, 2, 3, 8, 20};

std::vector<Budget> budgets() {
    std::vector<Budget> result;
    for (const std::size_t count : counts) {
        result.push_back({count, {}, Guarantee::outer});
    }
    return result;
}

/// Largest distance from the surface's samples to the spheres.
double gap(const Solid& solid, const std::vector<Sphere>& spheres) {
    double worst = 0;
    for (const SurfacePoint& sample : solid.sample_surface(1'000, 5)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Sphere& sphere : spheres) {
            nearest = std::min(nearest, distance(sample.point, sphere.center) - sphere.radius);
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

void check_tree(const Solid& solid, const SphereTree& tree, std::optional<std::size_t> most) {
    ASSERT_GE(tree.levels.size(), 1u);
    EXPECT_EQ(tree.levels[0].spheres.size(), 1u);
    EXPECT_TRUE(tree.levels[0].parents.empty());
    ASSERT_GE(tree.finest().size(), 1u);
    if (most) {
        EXPECT_LE(tree.finest().size(), *most);
    }
    const double size = solid.bounds().diagonal();
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        const SphereTree::Level& level = tree.levels[l];
        if (l > 0) {
            ASSERT_EQ(level.parents.size(), level.spheres.size());
            for (const std::uint32_t parent : level.parents) {
                EXPECT_LT(parent, tree.levels[l - 1].spheres.size());
            }
        }
        for (const Sphere& sphere : level.spheres) {
            ASSERT_TRUE(is_finite(sphere.center) && std::isfinite(sphere.radius));
            EXPECT_GT(sphere.radius, 0);
            EXPECT_LT(sphere.radius, 2 * size);
        }
        EXPECT_LE(gap(solid, level.spheres), 0.05 * size) << "level " << l << " does not stand for the whole solid";
    }
}

class SpherizerContract : public testing::TestWithParam<std::string> {
protected:
    SpherizerContract() {
        registry.load_directory(FOAM_TEST_PLUGINS);
        for (const auto& [name, stage] : registry.stages()) {
            if (stage.kind == StageKind::spherizer) {
                spherizers.push_back(name);
            }
        }
        solid = test::solids().at(GetParam())();
    }

    Registry registry;
    std::vector<std::string> spherizers;
    std::shared_ptr<const Solid> solid;
    QuietContext context{3};
};

TEST_P(SpherizerContract, BudgetsTreesAndCover) {
    EXPECT_THAT(spherizers, testing::IsSupersetOf({"spherize.grid", "spherize.octree"}));
    const Shape shape(GetParam(), solid, solid);
    for (const std::string& name : spherizers) {
        SCOPED_TRACE(name);
        const auto spherizer = registry.make<Spherizer>(name);
        const std::vector<Budget> wanted = budgets();
        const std::vector<SphereTree> trees = spherizer->spherize_each(shape, wanted, context);
        ASSERT_EQ(trees.size(), wanted.size());
        for (std::size_t i = 0; i < trees.size(); ++i) {
            SCOPED_TRACE(std::to_string(counts[i]) + " spheres");
            check_tree(*solid, trees[i], counts[i]);
            const std::vector<Sphere> grown = grown_to_cover(*solid, trees[i].finest());
            EXPECT_TRUE(certify(*solid, grown).holds);
        }
        EXPECT_EQ(spherizer->spherize(shape, wanted[3], context), trees[3])
            << "spherize() gives what spherize_each() gives";
    }
}

TEST_P(SpherizerContract, WithoutABudgetTheParametersRule) {
    const Shape shape(GetParam(), solid, solid);
    for (const std::string& name : spherizers) {
        SCOPED_TRACE(name);
        check_tree(*solid, registry.make<Spherizer>(name)->spherize(shape, {}, context), {});
    }
}

INSTANTIATE_TEST_SUITE_P(Solids, SpherizerContract, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const auto& [name, make] : test::solids()) {
                                 names.push_back(name);
                             }
                             return names;
                         }()),
                         [](const auto& test) { return test.param; });

class SpherizerThreads : public SpherizerContract {};

TEST_P(SpherizerThreads, TheSameSpheresFromEveryThread) {
    const Shape shape(GetParam(), solid, solid);
    for (const std::string& name : spherizers) {
        SCOPED_TRACE(name);
        const auto spherizer = registry.make<Spherizer>(name);
        const SphereTree expected = spherizer->spherize(shape, {8, {}, Guarantee::outer}, context);
        std::vector<SphereTree> trees(3);
        std::vector<std::thread> threads;
        for (SphereTree& tree : trees) {
            threads.emplace_back([&] {
                QuietContext own{3};
                tree = spherizer->spherize(shape, {8, {}, Guarantee::outer}, own);
            });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        for (const SphereTree& tree : trees) {
            EXPECT_EQ(tree, expected);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Solids, SpherizerThreads, testing::Values("Bracket", "Torus"),
                         [](const auto& test) { return test.param; });

class StopAtOnce final : public QuietContext {
public:
    bool cancelled() const override { return true; }
};

class SpherizerCancel : public SpherizerContract {};

TEST_P(SpherizerCancel, StopsWhenTheUserAsks) {
    const Shape shape(GetParam(), solid, solid);
    for (const std::string& name : spherizers) {
        SCOPED_TRACE(name);
        StopAtOnce stopped;
        try {
            registry.make<Spherizer>(name)->spherize(shape, {20, {}, Guarantee::outer}, stopped);
            ADD_FAILURE() << "went on";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::cancelled);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Solids, SpherizerCancel, testing::Values("Torus"),
                         [](const auto& test) { return test.param; });

} // namespace
