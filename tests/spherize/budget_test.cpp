// What every spherizer does with a budget that grows.
#include "all_spherizers.hpp"

#include <foam/host/contract.hpp>
#include <foam/inner.hpp>
#include <foam/measure.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;
using namespace foam::test;

class GrowingBudget : public testing::TestWithParam<std::string> {};

TEST_P(GrowingBudget, NeverClaimsMoreNorLeavesMoreOpen) {
    std::vector<Budget> budgets;
    for (const std::size_t count : {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 16, 24, 32}) {
        budgets.push_back({count, {}, Guarantee::outer});
    }
    const auto stage = all_spherizers().make<Spherizer>(GetParam());
    for (const std::string name : {"Box", "Bracket", "Torus", "TwoBoxes"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        QuietContext context;
        const std::vector<SphereTree> trees = stage->spherize_each({name, solid, solid}, budgets, context);
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < trees.size(); ++i) {
            const std::vector<Sphere> grown = grown_to_cover(*solid, trees[i].finest());
            EXPECT_TRUE(certify(*solid, grown).holds);
            // The figures that stages choose by are right to about 1/4000.
            const double claimed = union_volume(grown, 10'000);
            EXPECT_LE(claimed, least * (1 + 5e-4)) << *budgets[i].max_spheres << " spheres";
            least = std::min(least, claimed);
        }
        EXPECT_LT(least, 0.95 * union_volume(trees[0].finest())) << "no use is made of 32 spheres";
    }
}

/// Spherizers that heed the guarantee inner themselves. What others make is cut down to it, more spheres or fewer.
std::vector<std::string> heeding_inner() {
    std::vector<std::string> names = spherizer_names();
    std::erase_if(names, [](const std::string& name) {
        return name != "spherize.grid" && name != "spherize.octree" && name != "spherize.voxel" &&
               name != "spherize.medial" && name != "spherize.hubbard" && name != "spherize.spawn";
    });
    return names;
}

class GrowingBudgetInside : public GrowingBudget {};

TEST_P(GrowingBudgetInside, NeverMissesMore) {
    const auto stage = all_spherizers().make<Spherizer>(GetParam());
    for (const std::string name : {"Box", "Bracket", "Torus"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        QuietContext context;
        double most = 0;
        for (const std::size_t count : {1, 2, 4, 8, 16, 32}) {
            const SphereTree tree = stage->spherize({name, solid, solid}, {count, {}, Guarantee::inner}, context);
            const std::vector<Sphere> inside = shrunk_to_fit(*solid, tree.finest());
            EXPECT_TRUE(certify_inner(*solid, inside).holds);
            std::vector<Sphere> left = inside;
            std::erase_if(left, [](const Sphere& sphere) { return sphere.radius == 0; });
            const double held = union_volume(left, 4'000);
            EXPECT_GE(held, most * (1 - 1e-3)) << count << " spheres";
            most = std::max(most, held);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, GrowingBudget, testing::ValuesIn(spherizer_names()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

INSTANTIATE_TEST_SUITE_P(Spherizers, GrowingBudgetInside, testing::ValuesIn(heeding_inner()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
