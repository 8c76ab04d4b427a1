// Scalars, `--set`, sweeps, overrides and globs.
#include "support.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>

#include <gmock/gmock.h>

#include <clocale>
#include <thread>

namespace foam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RecipeValues : public testing::Test {
protected:
    void SetUp() override { load_fixtures(registry_); }

    RecipeResult parse(const std::string& text, const std::vector<Setting>& settings = {}) {
        return parse_recipe(text, "dir/cube.yaml", registry_, settings);
    }
    /// A mesh, and one of each filter.
    RecipeResult parse_chain(const std::string& rest, const std::vector<Setting>& settings = {}) {
        return parse(
            "foam: 1\nmesh: cube.stl\nstages: [repair.fixture, simplify.fixture: {ratio: 0.5}, smooth.fixture, "
            "spherize.fixture]\n" +
                rest,
            settings);
    }
    /// The value that `text` gives to a parameter of simplify.fixture or spherize.fixture; the findings if it is
    /// refused.
    std::string value(const std::string& parameter, const std::string& text) {
        const bool of_filter = parameter == "step" || parameter == "iterations";
        const std::string filter = of_filter ? "smooth.fixture: {" + parameter + ": " + text + "}, " : "";
        const std::string of_spherizer = of_filter ? "" : ": {" + parameter + ": " + text + "}";
        const RecipeResult result =
            parse("foam: 1\nmesh: cube.stl\nstages: [" + filter + "spherize.fixture" + of_spherizer + "]\n");
        if (!result.ok()) {
            return "error: " + result.diagnostics.at(0).message;
        }
        const Recipe& recipe = result.recipes.at(0);
        return to_text((of_filter ? recipe.filters.at(0) : recipe.spherizer).given.at(parameter));
    }

    Registry registry_;
};

TEST_F(RecipeValues, IntegersAreThoseOfTheCoreSchema) {
    EXPECT_EQ(value("branch", "12"), "12");
    EXPECT_EQ(value("branch", "010"), "10"); // octal in YAML 1.1
    EXPECT_EQ(value("branch", "+7"), "7");
    EXPECT_EQ(value("branch", "0x1F"), "31");
    EXPECT_EQ(value("branch", "0o17"), "15");
    EXPECT_EQ(value("branch", "9223372036854775807"), "9223372036854775807");
    EXPECT_EQ(value("branch", "1e3"), "1000"); // as in JSON Schema: an integer is a number without a fraction
    EXPECT_EQ(value("branch", "3.0"), "3");
    for (const char* wrong : {"\"12\"", "'12'", "1_000", "0b11", "3.5", "~", "yes", "0x", "0x-1", "0o8",
                              "9223372036854775808", "[1]", "{a: 1}", "1:30", "--1", "+", "1 2"}) {
        EXPECT_THAT(value("branch", wrong), HasSubstr("expects an integer of at least 1")) << wrong;
    }
}

TEST_F(RecipeValues, NumbersAreThoseOfTheCoreSchema) {
    EXPECT_EQ(value("step", ".5"), "0.5");
    EXPECT_EQ(value("step", "5."), "5");
    EXPECT_EQ(value("step", "1e3"), "1000");
    EXPECT_EQ(value("step", "+1.5E-2"), "0.015");
    EXPECT_EQ(value("step", "2"), "2");
    EXPECT_EQ(value("step", "0.1"), "0.1");
    for (const char* wrong : {".", "1e", ".inf", "-.inf", ".nan", "1e999", "0x1p3", "1.2.3", "\"0.5\"", "inf", "nan"}) {
        EXPECT_THAT(value("step", wrong), HasSubstr("expects a number of at least 0")) << wrong;
    }
}

TEST_F(RecipeValues, BooleansAreTrueAndFalseOnly) {
    for (const char* text : {"true", "True", "TRUE"}) {
        EXPECT_EQ(value("optimise", text), "true");
    }
    EXPECT_EQ(value("optimise", "FALSE"), "false");
    for (const char* wrong : {"yes", "no", "on", "off", "y", "tRUE", "1", "0", "\"true\"", "~"}) {
        EXPECT_THAT(value("optimise", wrong), HasSubstr("expects true or false")) << wrong;
    }
}

TEST_F(RecipeValues, IntegersGivenForNumbersBecomeNumbers) {
    const RecipeResult result = parse("foam: 1\nmesh: a.stl\nstages: [smooth.fixture: {step: 2}, spherize.fixture]\n");
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result.recipes[0].filters[0].given.at("step"), ParameterValue(2.0));
}

TEST_F(RecipeValues, DefaultsAreThoseOfTheDocumentation) {
    const RecipeResult result = parse("foam: 1\nrobot: {urdf: a.urdf}\nstages: [spherize.fixture]\n");
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    const Recipe& recipe = result.recipes.at(0);
    EXPECT_EQ(recipe.name, "cube");
    EXPECT_EQ(recipe.seed, 0U);
    EXPECT_TRUE(recipe.per_link);
    EXPECT_EQ(recipe.guarantee, Guarantee::outer);
    EXPECT_EQ(recipe.on_error, OnError::stop);
    EXPECT_FALSE(recipe.budget_spheres || recipe.budget_max_protrusion || recipe.snapshots || recipe.debug_meshes);
    ASSERT_EQ(recipe.outputs.size(), 2U);
    EXPECT_EQ(recipe.outputs[0].writer.stage, "write.urdf");
    EXPECT_EQ(recipe.outputs[0].file, "cube.urdf");
    EXPECT_EQ(recipe.outputs[1].file, "cube.json");
    EXPECT_EQ(recipe.spherizer.where.text(), "dir/cube.yaml:3:10");
    EXPECT_EQ(recipe.input_where.text(), "dir/cube.yaml:2:1");
}

TEST_F(RecipeValues, NameComesFromTheFileAndFitsAFolder) {
    const std::string text = "foam: 1\nmesh: a.stl\nstages: [spherize.fixture]\n";
    const auto name = [&](const std::string& file) { return parse_recipe(text, file, registry_).recipes.at(0).name; };
    EXPECT_EQ(name("x/panda_22.yaml"), "panda_22");
    EXPECT_EQ(name("x/my robot (2).yaml"), "my_robot__2_");
    EXPECT_EQ(name(""), "recipe");
    EXPECT_EQ(name("-.-.yaml"), "recipe");
}

TEST_F(RecipeValues, SettingsReachEveryPlace) {
    const std::vector<Setting> settings = {{"budget.spheres", "30"},
                                           {"stages.1.simplify.fixture.ratio", "0.1"},
                                           {"stages.smooth.fixture.iterations", "3"},
                                           {"stages.3.spherize.fixture.branch", "2"},
                                           {"links.*finger.skip", "true"},
                                           {"links.hand.spherize.fixture.branch", "4"},
                                           {"outputs", "[write.fixture: {file: a.txt}]"},
                                           {"outputs.0.write.fixture.file", "b.txt"},
                                           {"snapshots.pose.arm.joint", "0.5"},
                                           {"name", "other"}};
    const RecipeResult result = parse_chain("snapshots: true\n", settings);
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    const Recipe& recipe = result.recipes.at(0);
    EXPECT_EQ(recipe.budget_spheres, 30U);
    EXPECT_EQ(recipe.filters.at(1).given.at("ratio"), ParameterValue(0.1));
    EXPECT_EQ(recipe.filters.at(2).given.at("iterations"), ParameterValue(std::int64_t{3}));
    EXPECT_EQ(recipe.spherizer.given.at("branch"), ParameterValue(std::int64_t{2}));
    EXPECT_TRUE(recipe.for_link("left_finger").skip);
    EXPECT_EQ(recipe.for_link("hand").spherizer.given.at("branch"), ParameterValue(std::int64_t{4}));
    ASSERT_EQ(recipe.outputs.size(), 1U);
    EXPECT_EQ(recipe.outputs[0].file, "b.txt");
    EXPECT_EQ(recipe.pose.at("arm.joint"), 0.5);
    EXPECT_EQ(recipe.name, "other");
}

TEST_F(RecipeValues, LengthsMayHaveAUnit) {
    const RecipeResult result =
        parse_chain("budget: {max_protrusion: 10mm}\nunit: in\nscale: 3\n"
                    "links: {a: {max_protrusion: 0.4 in, clip: [{normal: [0, 0, 1], offset: -2cm, reach: '5 mm'}]}}\n",
                    {{"stages.smooth.fixture.step", "7mm"}});
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    const Recipe& recipe = result.recipes.at(0);
    EXPECT_EQ(recipe.budget_max_protrusion, 0.01);
    EXPECT_EQ(recipe.mesh_unit.unit, "in");
    EXPECT_EQ(recipe.mesh_unit.scale, 3);
    EXPECT_EQ(recipe.links.at(0).max_protrusion, 0.4 * 0.0254);
    EXPECT_EQ(recipe.links.at(0).clip->at(0).offset, -0.02);
    EXPECT_EQ(recipe.links.at(0).clip->at(0).reach, 0.005);
    EXPECT_EQ(recipe.filters.back().given.at("step"), ParameterValue(0.007));
}

TEST_F(RecipeValues, LengthsWithoutAUnitAreKnown) {
    const RecipeResult result =
        parse_chain("pad: 5\nbudget: {max_protrusion: 10mm, spheres: 3}\n"
                    "links: {a: {max_protrusion: 2, clip: [{normal: [0, 0, 1], offset: -2cm, reach: 7}]}}\n",
                    {{"stages.smooth.fixture.step", "3"}});
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    std::map<std::string, double> lengths;
    for (const PlainLength& length : result.recipes.at(0).plain_lengths) {
        lengths[length.name] = length.metres;
    }
    EXPECT_EQ(lengths, (std::map<std::string, double>{
                           {"pad", 5}, {"max_protrusion", 2}, {"reach of clip", 7}, {"step of smooth.fixture", 3}}));
    EXPECT_EQ(question_about({"pad", 5}, 0.8, "the robot"),
              "pad is 5 m, larger than the robot (800 mm); if it is in millimetres: 5mm");
    EXPECT_EQ(question_about({"pad", 0.7}, 0.8, "the robot"), "");
    EXPECT_EQ(question_about({"offset of clip", -5}, 0.8, "the robot").substr(0, 21), "offset of clip is -5 ");
    EXPECT_EQ(question_about({"pad", 5}, 0, "what is empty"), "");
}

TEST_F(RecipeValues, SettingsToNullTakeKeysAway) {
    const RecipeResult result = parse_chain("budget: {spheres: 3}\nsweep: {seed: [1, 2]}\n",
                                            {{"sweep", "null"}, {"budget.spheres", "~"}, {"stages.0", ""}});
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    ASSERT_EQ(result.recipes.size(), 1U);
    EXPECT_FALSE(result.recipes[0].budget_spheres);
    EXPECT_EQ(result.recipes[0].filters.size(), 2U);
}

TEST_F(RecipeValues, WrongSettingsAreFoundAtTheirNumber) {
    const auto findings = [&](const std::string& path, const std::string& text) {
        return text_of(parse_chain("seed: 1\nsweep: {budget.spheres: [1]}\n", {{path, text}}).diagnostics);
    };
    EXPECT_EQ(findings("budget.max_protrusion", "-1"),
              "--set:1:1: error[out-of-bounds]: 'max_protrusion' of budget expects a number of at least 0, got -1\n");
    EXPECT_EQ(findings("budgte.spheres", "1"),
              "--set:1:1: error[unknown-key]: unknown key 'budgte'; did you mean 'budget'?\n");
    EXPECT_EQ(findings("stages.9.x", "1"),
              "--set:1:1: error[bad-path]: cannot set 'stages.9.x': 'stages' has 4 items, counted from 0\n");
    EXPECT_EQ(findings("stages.simplify.fixtur.ratio", "1"),
              "--set:1:1: error[bad-path]: cannot set 'stages.simplify.fixtur.ratio': 'stages' has no item "
              "'simplify.fixtur.ratio'; known: repair.fixture, simplify.fixture, smooth.fixture, spherize.fixture\n");
    EXPECT_EQ(findings("seed.x", "1"),
              "--set:1:1: error[bad-path]: cannot set 'seed.x': 'seed' has no keys, it is 1\n");
    EXPECT_EQ(findings("", "1"), "--set:1:1: error[bad-path]: cannot set '': the path is not of the form key.key\n");
    EXPECT_EQ(findings("a..b", "1"),
              "--set:1:1: error[bad-path]: cannot set 'a..b': the path is not of the form key.key\n");
    EXPECT_EQ(findings("name", "[a"),
              "--set:1:1: error[syntax]: this '[' is never closed, or a ',' is missing in it; remedy: "
              "complete it\n");
    EXPECT_EQ(
        findings("budget.spheres", "4"),
        "--set:1:1: error[conflict]: 'budget.spheres' is swept by the recipe; remedy: --set sweep=null as well\n");
    EXPECT_EQ(text_of(parse_chain("", {{"seed", "1"}, {"seed", "x"}}).diagnostics),
              "--set:2:1: error[wrong-type]: 'seed' expects an integer of at least 0, got the text 'x'\n");
    EXPECT_EQ(
        text_of(
            parse_chain("", {{"stages.2", "simplify.fixture"}, {"stages.simplify.fixture.ratio", "1"}}).diagnostics),
        "--set:2:1: error[bad-path]: cannot set 'stages.simplify.fixture.ratio': 'simplify.fixture' is in 'stages' "
        "more "
        "than once; remedy: give its number, counted from 0\n");
}

TEST_F(RecipeValues, SweepsMakeAllCombinations) {
    const RecipeResult result = parse_chain("name: panda\nsweep:\n  budget.spheres: [11, 22]\n"
                                            "  stages.simplify.fixture.ratio: [0.1, .5, 1]\n");
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    std::vector<std::string> names;
    for (const Recipe& recipe : result.recipes) {
        names.push_back(recipe.name);
    }
    EXPECT_THAT(names,
                ElementsAre("panda-spheres=11-ratio=0.1", "panda-spheres=11-ratio=.5", "panda-spheres=11-ratio=1",
                            "panda-spheres=22-ratio=0.1", "panda-spheres=22-ratio=.5", "panda-spheres=22-ratio=1"));
    EXPECT_EQ(result.recipes[4].budget_spheres, 22U);
    EXPECT_EQ(result.recipes[4].filters[1].given.at("ratio"), ParameterValue(0.5));
    EXPECT_EQ(result.recipes[4].outputs[0].file, "panda-spheres=22-ratio=.5.json");
}

TEST_F(RecipeValues, SweepNamesAreDistinctFolderNames) {
    const auto names = [&](const std::string& sweep) {
        std::vector<std::string> result;
        for (const Recipe& recipe :
             parse("foam: 1\nname: x\nmesh: a\nstages: [simplify.fixture, spherize.fixture]\nsweep: " + sweep + "\n")
                 .recipes) {
            result.push_back(recipe.name);
        }
        return result;
    };
    EXPECT_THAT(names("{mesh: [a/b.stl, 'c d.stl']}"), ElementsAre("x-mesh=a_b.stl", "x-mesh=c_d.stl"));
    EXPECT_THAT(names("{mesh: [a/b, a_b]}"), ElementsAre("x-mesh=1", "x-mesh=2"));
    EXPECT_THAT(names("{mesh: [[a, b], [c]]}"), ElementsAre("x-mesh=1", "x-mesh=2"));
    EXPECT_THAT(names("{budget: [{spheres: 1}, {spheres: 2}]}"), ElementsAre("x-budget=1", "x-budget=2"));
    EXPECT_THAT(names("{links.a.skip: [true], links.b.skip: [false]}"),
                ElementsAre("x-links.a.skip=true-links.b.skip=false"));
    EXPECT_THAT(names("{mesh: [" + std::string(50, 'a') + ", b]}"), ElementsAre("x-mesh=1", "x-mesh=2"));
}

TEST_F(RecipeValues, LoadersHaveParameters) {
    const RecipeResult result = parse_chain("loaders: {load.fixture: {max_triangles: 12}}\n");
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    const Recipe& recipe = result.recipes.at(0);
    EXPECT_EQ(recipe.loader_call("load.fixture").given.at("max_triangles"), ParameterValue(std::int64_t{12}));
    EXPECT_TRUE(recipe.loader_call("load.other").given.empty());
    EXPECT_NE(to_yaml(recipe, registry_).find("\nloaders: {load.fixture: {max_triangles: 12}}\n"), std::string::npos);
}

TEST_F(RecipeValues, OverridesAreMergedInOrder) {
    const RecipeResult result =
        parse_chain("links:\n"
                    "  '*': {max_spheres: 8, simplify.fixture: {mode: exact}}\n"
                    "  '*finger': {skip: true, max_spheres: 2}\n"
                    "  left_finger: {skip: false, min_spheres: 2, simplify.fixture: {ratio: 0.9}}\n");
    ASSERT_TRUE(result.ok()) << text_of(result.diagnostics);
    const Recipe& recipe = result.recipes.at(0);
    const Recipe::LinkRecipe hand = recipe.for_link("hand");
    EXPECT_FALSE(hand.skip);
    EXPECT_EQ(hand.min_spheres, 1U);
    EXPECT_EQ(hand.max_spheres, 8U);
    EXPECT_EQ(hand.filters.at(1).given.at("mode"), ParameterValue(std::string("exact")));
    EXPECT_EQ(hand.filters.at(1).given.at("ratio"), ParameterValue(0.5));
    EXPECT_TRUE(recipe.for_link("right_finger").skip);
    const Recipe::LinkRecipe left = recipe.for_link("left_finger");
    EXPECT_FALSE(left.skip);
    EXPECT_EQ(left.min_spheres, 2U);
    EXPECT_EQ(left.max_spheres, 2U);
    EXPECT_EQ(left.filters.at(1).given.at("ratio"), ParameterValue(0.9));
    EXPECT_EQ(left.filters.at(1).given.at("mode"), ParameterValue(std::string("exact")));
}

TEST_F(RecipeValues, ContradictingLimitsOfGlobsAreAnError) {
    const RecipeResult result = parse_chain("links: {'a*': {min_spheres: 5}, '*b': {max_spheres: 4}}\n");
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result.recipes[0].for_link("a").min_spheres, 5U);
    try {
        result.recipes[0].for_link("ab");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::recipe);
        EXPECT_STREQ(error.what(), "link 'ab' is to have at least 5 and at most 4 spheres; remedy: correct 'links'");
    }
}

TEST_F(RecipeValues, LocaleChangesNothing) {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    if (!std::setlocale(LC_ALL, "de_DE.UTF-8")) {
        GTEST_SKIP() << "no German locale here";
    }
    EXPECT_EQ(value("step", "0.5"), "0.5");
    std::setlocale(LC_ALL, before.c_str());
}

/// ".." stays: behind a symbolic link it is not the folder before.
TEST_F(RecipeValues, AbsolutePathsStartAtTheRecipe) {
    const RecipeResult result = parse("foam: 1\nrobot: {urdf: [package://p/a.urdf, ../b.urdf, /c.urdf]}\n"
                                      "package_path: x\nstages: [spherize.fixture]\n");
    ASSERT_TRUE(result.ok());
    Recipe recipe = result.recipes.at(0);
    recipe.file = "/home/me/dir/cube.yaml";
    const std::string text = to_yaml(recipe, registry_, true);
    EXPECT_THAT(text, HasSubstr("robot: {urdf: [\"package://p/a.urdf\", /home/me/dir/../b.urdf, /c.urdf]}\n"));
    EXPECT_THAT(text, HasSubstr("package_path: [/home/me/dir/x]\n"));
}

TEST(Glob, MatchesWholeNames) {
    for (const auto& [glob, name] :
         std::vector<std::pair<const char*, const char*>>{{"hand", "hand"},
                                                          {"*", ""},
                                                          {"*", "x"},
                                                          {"*finger", "left_finger"},
                                                          {"finger*", "finger"},
                                                          {"f?nger", "finger"},
                                                          {"l*_*r", "left_finger"},
                                                          {"[lr]_arm", "l_arm"},
                                                          {"link[0-9]", "link7"},
                                                          {"link[!0-9]", "linkx"},
                                                          {"[]]", "]"},
                                                          {"a[-]b", "a-b"},
                                                          {"*a*a*a*b", "aaaaaaaaaaaaaaaaaaaaab"},
                                                          {"**", "ab"}}) {
        EXPECT_TRUE(glob_matches(glob, name)) << glob << " " << name;
    }
    for (const auto& [glob, name] : std::vector<std::pair<const char*, const char*>>{
             {"hand", "hands"},
             {"hand", "han"},
             {"", "x"},
             {"?", ""},
             {"*finger", "finger_left"},
             {"link[0-9]", "linkx"},
             {"link[!0-9]", "link7"},
             {"link[0-9", "link7"},
             {"Hand", "hand"},
             {"*a*a*a*a*a*a*a*a*a*b", "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"}}) {
        EXPECT_FALSE(glob_matches(glob, name)) << glob << " " << name;
    }
}

} // namespace
} // namespace foam::test
