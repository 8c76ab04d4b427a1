// extends, set and variants.
#include "support.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/text.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Recipes over a base, in a folder of their own that messages do not show.
class RecipeExtends : public testing::Test {
protected:
    void SetUp() override {
        load_fixtures(registry_);
        write("base/arm.yaml", "foam: 1\nname: arm\nmesh: [package://arm/a.stl, parts/a.stl, /a.stl]\n"
                               "stages:\n  - simplify.fixture: {ratio: 0.5}\n  - spherize.fixture: {branch: 3}\n"
                               "budget: {spheres: 20}\nlinks:\n  '*': {max_spheres: 8}\n  hand: {max_spheres: 4}\n"
                               "outputs: [write.fixture: {file: arm.txt}]\n"
                               "variants: {fine: {budget.spheres: 80, seed: 3}, coarse: {budget.spheres: 2}}\n");
    }

    void write(const std::string& name, const std::string& text) const {
        const auto file = folder_.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
    }
    RecipeResult read(const std::string& name, const std::vector<std::string>& variants = {},
                      const std::vector<Setting>& settings = {}) {
        return read_recipe(folder_.path() / name, registry_, settings, variants);
    }
    /// The one run of a recipe that extends the base.
    Recipe over_base(const std::string& text, const std::vector<std::string>& variants = {},
                     const std::vector<Setting>& settings = {}) {
        write("mine.yaml", "foam: 1\nextends: base/arm.yaml\n" + text);
        const RecipeResult result = read("mine.yaml", variants, settings);
        EXPECT_EQ(text_of(result.diagnostics), "");
        return result.recipes.size() == 1 ? result.recipes[0] : Recipe{};
    }
    std::string findings(const std::string& name, const std::vector<std::string>& variants = {}) {
        std::string text = text_of(read(name, variants).diagnostics);
        const std::string folder = folder_.path().string() + "/";
        for (std::size_t at = 0; (at = text.find(folder)) != text.npos;) {
            text.erase(at, folder.size());
        }
        return text;
    }

    Registry registry_;
    TemporaryFolder folder_;
};

TEST_F(RecipeExtends, TakesAllButTheName) {
    const Recipe recipe = over_base("");
    EXPECT_EQ(recipe.name, "mine");
    EXPECT_EQ(recipe.budget_spheres, 20U);
    ASSERT_EQ(recipe.filters.size(), 1U);
    EXPECT_EQ(recipe.outputs.at(0).file, "arm.txt");
    ASSERT_EQ(recipe.extended.size(), 1U);
    EXPECT_EQ(recipe.extended[0].file, folder_.path() / "base/arm.yaml");
    EXPECT_EQ(recipe.extended[0].text, read_file(folder_.path() / "base/arm.yaml"));
}

TEST_F(RecipeExtends, ReferencesAreRelativeToTheFileInWhichTheyStand) {
    EXPECT_THAT(over_base("").mesh, ElementsAre("package://arm/a.stl", "base/parts/a.stl", "/a.stl"));
    EXPECT_THAT(over_base("mesh: parts/b.stl\npackage_path: packages\n").mesh, ElementsAre("parts/b.stl"));
    write("base/deep/other.yaml", "foam: 1\nextends: ../arm.yaml\npackage_path: [packages]\n");
    write("mine.yaml", "foam: 1\nextends: base/deep/other.yaml\n");
    const RecipeResult result = read("mine.yaml");
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    EXPECT_THAT(result.recipes[0].package_path, ElementsAre("base/deep/packages"));
    EXPECT_THAT(result.recipes[0].mesh, ElementsAre("package://arm/a.stl", "base/deep/../parts/a.stl", "/a.stl"));
    EXPECT_EQ(result.recipes[0].extended.size(), 2U);
}

TEST_F(RecipeExtends, MapsAreMergedListsReplacedNullTakesAway) {
    const Recipe recipe = over_base("stages: [spherize.fixture]\nbudget: {max_protrusion: 0.1}\n"
                                    "links:\n  hand: {min_spheres: 2}\n  finger: {skip: true}\noutputs: []\n");
    EXPECT_TRUE(recipe.filters.empty());
    EXPECT_TRUE(recipe.spherizer.given.empty());
    EXPECT_EQ(recipe.budget_spheres, 20U);
    EXPECT_EQ(recipe.budget_max_protrusion, 0.1);
    EXPECT_TRUE(recipe.outputs.empty());
    EXPECT_EQ(recipe.for_link("hand").max_spheres, 4U);
    EXPECT_EQ(recipe.for_link("hand").min_spheres, 2U);
    EXPECT_TRUE(recipe.for_link("finger").skip);
    const Recipe less = over_base("budget: null\nlinks: {hand: null, '*': {max_spheres: null}}\n");
    EXPECT_FALSE(less.budget_spheres);
    EXPECT_FALSE(less.for_link("hand").max_spheres);
}

/// A glob that the base has keeps its place, others come behind it: later ones win.
TEST_F(RecipeExtends, GlobsKeepTheirOrder) {
    const Recipe recipe = over_base("links: {'h*': {max_spheres: 6}, '*': {max_spheres: 7}}\n");
    std::vector<std::string> globs;
    for (const LinkOverride& link : recipe.links) {
        globs.push_back(link.glob);
    }
    EXPECT_THAT(globs, ElementsAre("*", "hand", "h*"));
    EXPECT_EQ(recipe.for_link("hand").max_spheres, 6U);
    EXPECT_EQ(recipe.for_link("foot").max_spheres, 7U);
}

TEST_F(RecipeExtends, EveryValueKnowsTheFileItCameFrom) {
    const Recipe recipe = over_base("links: {hand: {min_spheres: 2}}\n");
    const std::string folder = folder_.path().string();
    EXPECT_EQ(recipe.spherizer.where.text(), folder + "/base/arm.yaml:6:5");
    EXPECT_EQ(recipe.input_where.text(), folder + "/base/arm.yaml:3:1");
    EXPECT_EQ(recipe.links.at(0).where.text(), folder + "/base/arm.yaml:9:3");
    EXPECT_EQ(recipe.links.at(1).where.text(), folder + "/mine.yaml:3:9");
    write("mine.yaml", "foam: 1\nextends: base/arm.yaml\nlinks: {hand: {min_spheres: 5}}\n");
    EXPECT_EQ(findings("mine.yaml"), "mine.yaml:3:9: error[conflict]: link 'hand' is to have at least 5 and at most 4 "
                                     "spheres; remedy: correct 'links'\n");
}

TEST_F(RecipeExtends, SetVariantAndCommandLineWinInThatOrder) {
    const std::string set = "set: {budget.spheres: 30, stages.simplify.fixture.ratio: 0.3, seed: 1}\n";
    const Recipe own = over_base(set);
    EXPECT_EQ(own.budget_spheres, 30U);
    EXPECT_EQ(own.filters.at(0).given.at("ratio"), ParameterValue(0.3));
    const Recipe fine = over_base(set, {"fine"});
    EXPECT_EQ(fine.name, "mine-fine");
    EXPECT_EQ(fine.variant, "fine");
    EXPECT_EQ(fine.budget_spheres, 80U);
    EXPECT_EQ(fine.seed, 3U);
    EXPECT_EQ(fine.filters.at(0).given.at("ratio"), ParameterValue(0.3));
    EXPECT_EQ(over_base(set, {"fine"}, {{"budget.spheres", "7"}}).budget_spheres, 7U);
}

TEST_F(RecipeExtends, AVariantOfTheSameNameReplacesTheBases) {
    const Recipe fine = over_base("variants: {fine: {budget.spheres: 60}}\n", {"fine"});
    EXPECT_EQ(fine.budget_spheres, 60U);
    EXPECT_EQ(fine.seed, 0U) << "the base's variant sets it";
    write("mine.yaml", "foam: 1\nextends: base/arm.yaml\nvariants: {coarse: null, tiny: {}}\n");
    EXPECT_THAT(read("mine.yaml").variants, ElementsAre("fine", "tiny"));
}

TEST_F(RecipeExtends, VariantsAreChosenByNameOrGlob) {
    const auto names = [&](const std::vector<std::string>& wanted) {
        std::vector<std::string> result;
        for (const Recipe& recipe : read("base/arm.yaml", wanted).recipes) {
            result.push_back(recipe.name);
        }
        return result;
    };
    EXPECT_THAT(names({}), ElementsAre("arm"));
    EXPECT_THAT(names({"*"}), ElementsAre("arm-fine", "arm-coarse"));
    EXPECT_THAT(names({"coarse", "fine"}), ElementsAre("arm-fine", "arm-coarse"));
    EXPECT_EQ(findings("base/arm.yaml", {"fine", "caorse"}),
              "--variant:2:1: error[unknown-variant]: the recipe has no variant 'caorse'; did you mean 'coarse'?\n");
    write("plain.yaml", "foam: 1\nmesh: a.stl\nstages: [spherize.fixture]\n");
    EXPECT_EQ(findings("plain.yaml", {"*"}), "--variant:1:1: error[unknown-variant]: the recipe has no variants\n");
}

/// Changes of the command line are for what runs; variants that do not run are checked as they stand.
TEST_F(RecipeExtends, VariantsThatAreNotChosenAreCheckedToo) {
    write("v.yaml", "foam: 1\nmesh: a.stl\nstages: [simplify.fixture, spherize.fixture]\n"
                    "variants: {bare: {stages: [spherize.fixture]}, bad: {seed: x}}\n");
    EXPECT_EQ(findings("v.yaml", {"bare"}),
              "v.yaml:4:60: error[wrong-type]: 'seed' expects an integer of at least 0, got the text 'x'\n");
    write("v.yaml", "foam: 1\nmesh: a.stl\nstages: [simplify.fixture, spherize.fixture]\n"
                    "variants: {bare: {stages: [spherize.fixture]}}\n");
    EXPECT_TRUE(read("v.yaml", {}, {{"stages.simplify.fixture.ratio", "1"}}).ok());
    EXPECT_FALSE(read("v.yaml", {"bare"}, {{"stages.simplify.fixture.ratio", "1"}}).ok());
}

TEST_F(RecipeExtends, ASweepOfAVariantNamesBoth) {
    write("v.yaml", "foam: 1\nmesh: a.stl\nstages: [spherize.fixture]\nsweep: {seed: [1, 2]}\n"
                    "variants: {fine: {budget.spheres: 9}}\n");
    const RecipeResult result = read("v.yaml", {"fine"});
    ASSERT_EQ(result.recipes.size(), 2U) << text_of(result.diagnostics);
    EXPECT_EQ(result.recipes[1].name, "v-fine-seed=2");
    EXPECT_EQ(result.recipes[1].budget_spheres, 9U);
}

TEST_F(RecipeExtends, AChainHasAnEnd) {
    for (int i = 0; i < 20; ++i) {
        write("c" + std::to_string(i) + ".yaml", "foam: 1\nextends: c" + std::to_string(i + 1) + ".yaml\n");
    }
    EXPECT_EQ(findings("c0.yaml"),
              "c15.yaml:2:10: error[too-deep]: more than 16 files extend one another; no recipe needs that\n");
    EXPECT_THAT(findings("c10.yaml"), HasSubstr("c19.yaml:2:10: error[cannot-read]: c20.yaml: there is no such file"));
    std::filesystem::create_symlink("s.yaml", folder_.path() / "link.yaml");
    write("s.yaml", "foam: 1\nextends: link.yaml\n");
    EXPECT_EQ(findings("s.yaml"), "s.yaml:2:10: error[cycle]: files extend each other in a circle: s.yaml -> s.yaml; "
                                  "remedy: delete one 'extends'\n");
}

TEST_F(RecipeExtends, PluginsOfTheBaseAreBesideIt) {
    std::filesystem::copy_file(std::string(FOAM_TEST_FIXTURES) + "/fixture_stages.so", folder_.path() / "base/mine.so");
    write("base/own.yaml", "foam: 1\nplugins: mine.so\nmesh: a.stl\noutputs: []\n");
    write("mine.yaml", "foam: 1\nextends: base/own.yaml\nstages: [spherize.fixture]\n"
                       "links: {hand: {}}\nset: {links.hand.spherize.fixture.branch: 2}\n");
    Registry empty;
    const RecipeResult result = read_recipe(folder_.path() / "mine.yaml", empty);
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    EXPECT_THAT(result.recipes[0].plugins, ElementsAre("base/mine.so"));
    EXPECT_EQ(result.recipes[0].for_link("hand").spherizer.given.at("branch"), ParameterValue(std::int64_t{2}));
}

TEST_F(RecipeExtends, WhatIsWrittenOutHasNoBaseAndNoVariants) {
    const Recipe recipe = over_base("set: {seed: 4}\n", {"coarse"});
    const std::string text = to_yaml(recipe, registry_);
    for (const char* key : {"extends", "set", "variants", "sweep"}) {
        EXPECT_EQ(text.find(key), text.npos) << text;
    }
    const RecipeResult again = parse_recipe(text, folder_.path() / "mine.yaml", registry_);
    ASSERT_TRUE(again.ok()) << text_of(again.diagnostics);
    EXPECT_EQ(to_yaml(again.recipes.at(0), registry_), text);
    EXPECT_EQ(again.recipes[0].name, "mine-coarse");
}

} // namespace
} // namespace foam::test
