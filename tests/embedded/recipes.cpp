// The committed recipes: every one is valid, names the embedded model as its last source, and gives what it promises.
#include "support/shared_folder.hpp"

#include <foam/recipe/recipe.hpp>
#include <foam/runtime/run.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace foam {
namespace {

const std::filesystem::path configs = FOAM_TEST_SOURCE "/configs";

std::string findings(const RecipeResult& result) {
    std::string text;
    for (const Diagnostic& diagnostic : result.diagnostics) {
        text += diagnostic.text() + "\n";
    }
    return text;
}

class Recipes : public testing::Test {
protected:
    void SetUp() override {
        // Robots of whoever runs the tests must not take the embedded model's place.
        for (const char* name : {"FOAM_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
            ::unsetenv(name);
        }
        registry.load_directory(FOAM_TEST_PLUGINS);
    }

    /// The recipe without pictures, on the embedded robot, nothing written, nothing cached.
    RunResult run_recipe(const std::string& name) {
        const RecipeResult read = read_recipe(configs / name, registry, {{"snapshots", "false"}, {"debug", "{}"}});
        EXPECT_TRUE(read.ok()) << findings(read);
        RunOptions options;
        options.fresh = true;
        return run(read.recipes.at(0), registry, options);
    }

    Registry registry;
};

TEST_F(Recipes, AllAreValid) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(configs)) {
        if (entry.path().extension() != ".yaml") {
            continue;
        }
        const RecipeResult read = read_recipe(entry.path(), registry);
        EXPECT_TRUE(read.ok() && read.diagnostics.empty()) << findings(read);
        EXPECT_EQ(read.recipes.at(0).name.rfind(entry.path().stem().string(), 0), 0U) << read.recipes.at(0).name;
        EXPECT_EQ(read.recipes.at(0).source.find("# yaml-language-server: $schema=../schemas/recipe.schema.json\n"),
                  0U);
        ++count;
    }
    EXPECT_GE(count, 6U);
}

TEST_F(Recipes, SweepHasOnePointABudget) {
    const RecipeResult read = read_recipe(configs / "panda_sweep.yaml", registry);
    ASSERT_TRUE(read.ok()) << findings(read);
    std::vector<std::size_t> budgets;
    for (const Recipe& recipe : read.recipes) {
        budgets.push_back(recipe.budget_spheres.value_or(0));
    }
    EXPECT_EQ(budgets, (std::vector<std::size_t>{11, 22, 27, 92, 316}));
}

TEST_F(Recipes, FallBackToTheEmbeddedModel) {
    const RecipeResult read = read_recipe(configs / "panda_22.yaml", registry);
    ASSERT_TRUE(read.ok()) << findings(read);
    std::string chosen;
    const ResolvedResource resolved = resolve_input(read.recipes.at(0), &chosen);
    EXPECT_EQ(chosen, "robots/panda/panda.urdf");
    EXPECT_TRUE(std::filesystem::equivalent(resolved.path, configs / "robots/panda/panda.urdf"));
}

TEST_F(Recipes, TakeTheRealModelWhenItsPackageIsThere) {
    const std::filesystem::path packages = shared_folder() / "robots/panda";
    if (!std::filesystem::exists(packages)) {
        GTEST_SKIP() << packages << " is not there";
    }
    ::setenv("FOAM_PACKAGE_PATH", packages.c_str(), 1);
    const RecipeResult read = read_recipe(configs / "panda_22.yaml", registry);
    ASSERT_TRUE(read.ok()) << findings(read);
    std::string chosen;
    resolve_input(read.recipes.at(0), &chosen);
    EXPECT_EQ(chosen, "package://moveit_resources_panda_description/urdf/panda.urdf");
}

// Upper bounds a tenth above what was reached when they were set: better is welcome, worse is a finding.
TEST_F(Recipes, Panda22KeepsItsFigures) {
    const RunResult result = run_recipe("panda_22.yaml");
    EXPECT_EQ(result.total.spheres, 22U);
    EXPECT_EQ(result.links.size(), 11U);
    EXPECT_FALSE(result.links_lost);
    for (const LinkReport& link : result.links) {
        EXPECT_EQ(link.error, "") << link.link;
        EXPECT_GE(link.measures.spheres, 1U) << link.link;
        EXPECT_TRUE(link.measures.certified) << link.link;
        EXPECT_EQ(link.measures.gap, 0.0) << link.link;
        EXPECT_EQ(link.measures.covered, 1.0) << link.link;
    }
    EXPECT_LE(result.total.excess, 1.09);
    EXPECT_GT(result.total.excess, 0.3) << "22 spheres cannot be that tight: is the volume right?";
    EXPECT_LE(result.total.protrusion_max, 0.076);
    EXPECT_NEAR(result.total.volume, 0.0173, 0.0004) << "of the embedded model, m³";

    // The same mesh turned by half a turn: the fingers get the same spheres.
    std::map<std::string, const SphereGroup*> groups;
    for (const SphereGroup& group : result.model.groups) {
        groups[group.link] = &group;
    }
    const auto& left = groups.at("panda_leftfinger")->tree.finest();
    const auto& right = groups.at("panda_rightfinger")->tree.finest();
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_NEAR(left[i].radius, right[i].radius, 1e-4);
        EXPECT_NEAR(left[i].center.x, -right[i].center.x, 1e-3);
        EXPECT_NEAR(left[i].center.y, -right[i].center.y, 1e-3);
    }
}

} // namespace
} // namespace foam
