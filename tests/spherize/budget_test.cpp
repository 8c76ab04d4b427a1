// What every spherizer does with a budget that grows.
#include "all_spherizers.hpp"

#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

#include <bit>

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
        const Shape shape(name, solid, solid);
        QuietContext context;
        const std::vector<SphereTree> trees = stage->search(shape)->at_most(budgets, context);
        // Each number is a search of its own for spherize.medial: only clearly more spheres never claim more.
        const double allowed = GetParam() == "spherize.medial" ? 0.03 : 1e-12;
        double least = std::numeric_limits<double>::infinity(), least_of_doubled = least;
        for (std::size_t i = 0; i < trees.size(); ++i) {
            const std::vector<Sphere> grown = grown_to_cover(*solid, trees[i].finest());
            EXPECT_TRUE(certify(*solid, grown).holds);
            const double claimed = exact_union_volume(grown) + solid->missing_volume(grown);
            EXPECT_LE(claimed, least * (1 + allowed)) << *budgets[i].max_spheres << " spheres";
            if (std::has_single_bit(*budgets[i].max_spheres)) {
                EXPECT_LE(claimed, least_of_doubled * (1 + 1e-6)) << *budgets[i].max_spheres << " spheres";
                least_of_doubled = std::min(least_of_doubled, claimed);
            }
            least = std::min(least, claimed);
        }
        EXPECT_LT(least, 0.95 * union_volume(trees[0].finest())) << "no use is made of 32 spheres";
    }
}

/// Spherizers that heed the guarantee inner themselves. What others make is cut down to it, more spheres or fewer.
std::vector<std::string> heeding_inner() {
    std::vector<std::string> names = spherizer_names();
    std::erase_if(names, [](const std::string& name) {
        return name != "spherize.cover" && name != "spherize.grid" && name != "spherize.octree" &&
               name != "spherize.voxel" && name != "spherize.medial" && name != "spherize.hubbard" &&
               name != "spherize.spawn";
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
            const double held = exact_union_volume(left);
            EXPECT_GE(held, most * (1 - 1e-12)) << count << " spheres";
            most = std::max(most, held);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Spherizers, GrowingBudget, testing::ValuesIn(spherizer_names()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

INSTANTIATE_TEST_SUITE_P(Spherizers, GrowingBudgetInside, testing::ValuesIn(heeding_inner()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

} // namespace
