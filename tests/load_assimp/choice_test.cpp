// Which loader reads a file, and in which process.
#include "exported.hpp"
#include "isolation/ill.hpp"
#include "support/runs.hpp"

#include <foam/base/error.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/runtime/plan.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ChoiceOfLoader : public RunTest {
protected:
    ChoiceOfLoader() {
        const auto scene = scene_of(sample::bracket());
        for (const Format& format : {Format{"3ds", "3ds"}, Format{"stlb", "stl"}, Format{"fbxa", "fbx"}}) {
            export_scene(*scene, format.id, folder.path() / (std::string("part.") + format.ending));
        }
    }

    Recipe recipe(const std::string& mesh, const std::string& rest = "") {
        return recipe_of("mesh: " + mesh + "\nstages: [spherize.octree]\noutputs: [write.json: {file: part.json}]\n" +
                         rest);
    }
    RunOptions options() const {
        RunOptions result = RunTest::options();
        result.program = FOAM_TEST_BINARY;
        return result;
    }
    std::string loader_of(const std::string& mesh, const std::string& rest = "") {
        const Plan planned = plan(recipe(mesh, rest), registry, options());
        EXPECT_EQ(planned.links.at(0).error, "");
        return planned.meshes.at(0).loader;
    }
    std::string error_of(const std::string& mesh, const std::string& rest = "") {
        return plan(recipe(mesh, rest), registry, options()).links.at(0).error;
    }
    std::string finding_of(const std::string& rest) {
        const RecipeResult result =
            parse_recipe("foam: 1\nmesh: part.3ds\nstages: [spherize.octree]\n" + rest, "recipe.yaml", registry);
        return result.diagnostics.empty() ? "" : result.diagnostics.front().text();
    }
};

TEST_F(ChoiceOfLoader, OursGoFirst) {
    EXPECT_EQ(loader_of("part.stl"), "load.mesh");
    EXPECT_EQ(loader_of("part.3ds"), "load.assimp");
}

TEST_F(ChoiceOfLoader, PreferTurnsItRound) {
    const std::string assimp = "loaders: {prefer: load.assimp}\n", ours = "loaders: {prefer: load.mesh}\n";
    EXPECT_EQ(loader_of("part.stl", assimp), "load.assimp");
    EXPECT_EQ(loader_of("part.3ds", assimp), "load.assimp");
    EXPECT_EQ(loader_of("part.stl", ours), "load.mesh");
    EXPECT_EQ(loader_of("part.3ds", ours), "load.assimp") << "load.mesh cannot read it";
}

TEST_F(ChoiceOfLoader, ARobotHasBoth) {
    write("robot.urdf",
          "<robot name=\"r\"><link name=\"a\"><collision><geometry><mesh filename=\"part.3ds\"/></geometry>"
          "</collision><collision><geometry><mesh filename=\"part.stl\"/></geometry></collision></link>"
          "</robot>\n");
    const Recipe both = recipe_of("robot: {urdf: robot.urdf}\nstages: [spherize.octree]\n");
    const Plan planned = plan(both, registry, options());
    std::vector<std::string> loaders;
    for (const PlannedFile& mesh : planned.meshes) {
        loaders.push_back(mesh.file.filename().string() + " " + mesh.loader);
    }
    EXPECT_THAT(loaders, ElementsAre("part.3ds load.assimp", "part.stl load.mesh"));
}

TEST_F(ChoiceOfLoader, BothReadersGiveTheSameSpheres) {
    run(recipe("part.stl"), registry, options());
    const std::string ours = text_of("out/part.json");
    RunOptions again = options();
    again.out = folder.path() / "again";
    run(recipe("part.stl", "loaders: {prefer: load.assimp}\n"), registry, again);
    EXPECT_EQ(text_of("again/part.json"), ours);
    EXPECT_NE(ours, "");
}

TEST_F(ChoiceOfLoader, ThePreferredOneIsChecked) {
    EXPECT_EQ(finding_of("loaders: {prefer: load.asimp}\n"),
              "recipe.yaml:4:19: error[unknown-stage]: unknown stage 'load.asimp'; did you mean 'load.assimp'?");
    EXPECT_EQ(finding_of("loaders: {prefer: spherize.octree}\n"),
              "recipe.yaml:4:19: error[wrong-kind]: 'spherize.octree' is a spherizer, no loader");
    EXPECT_THAT(
        finding_of("loaders: {prefer: [load.mesh]}\n"),
        HasSubstr("recipe.yaml:4:19: error[wrong-type]: 'prefer' of loaders expects the name of a loader, got "));
}

TEST_F(ChoiceOfLoader, ThePreferredOneIsWrittenOut) {
    const std::string text = to_yaml(recipe("part.stl", "loaders: {prefer: load.assimp}\n"), registry);
    EXPECT_THAT(text, HasSubstr("\nloaders: {prefer: load.assimp}\n"));
    EXPECT_EQ(parse_recipe(text, folder.path() / "recipe.yaml", registry).recipes.at(0).preferred_loader,
              "load.assimp");
}

TEST_F(ChoiceOfLoader, TheUnitIsThatOfTheLoader) {
    EXPECT_THAT(finding_of("loaders: {prefer: load.assimp}\nunit: mm\n"), "");
    EXPECT_THAT(parse_recipe("foam: 1\nmesh: part.fbx\nstages: [spherize.octree]\nunit: mm\n", "recipe.yaml", registry)
                    .diagnostics.at(0)
                    .text(),
                HasSubstr("part.fbx says its unit itself, as every fbx does"));
}

TEST_F(ChoiceOfLoader, NeedsAProgramThatIsolates) {
    RunOptions without = options();
    without.program.clear();
    EXPECT_THAT(plan(recipe("part.3ds"), registry, without).links.at(0).error,
                HasSubstr("this program cannot run stages in child processes; remedy: set isolate: none for "
                          "load.assimp, or run it with foam"));
    EXPECT_EQ(
        plan(recipe("part.3ds", "loaders: {load.assimp: {isolate: none}}\n"), registry, without).links.at(0).error, "");
    EXPECT_EQ(plan(recipe("part.3ds", "isolate: none\n"), registry, without).links.at(0).error, "");
}

TEST_F(ChoiceOfLoader, ItsLimitsAreTheRecipes) {
    EXPECT_EQ(finding_of("loaders: {load.assimp: {time_limit: 30}}\n"), "");
    EXPECT_THAT(finding_of("loaders: {load.assimp: {isolate: none, time_limit: 30}}\n"),
                HasSubstr("error[conflict]: 'time_limit' of load.assimp needs process isolation"));
}

TEST_F(ChoiceOfLoader, WantOfTimeAndMemoryIsReportedWithTheFile) {
    // A million triangles: no machine reads them in a millisecond or in 64 MiB.
    export_scene(*scene_of(sample::torus(1, 0.3, 1000, 500)), "assbin", folder.path() / "large.assbin");
    EXPECT_THAT(error_of("large.assbin", "loaders: {load.assimp: {time_limit: 0.001}}\n"),
                HasSubstr("large.assbin': the stage took longer than its time_limit of 0.001 s and was stopped; "
                          "remedy: "));
    if (!sanitized) { // a sanitizer keeps no memory_limit
        EXPECT_THAT(error_of("large.assbin", "loaders: {load.assimp: {memory_limit: 64}}\n"),
                    ::testing::AllOf(HasSubstr("large.assbin"), HasSubstr("memory"), HasSubstr("remedy: ")));
    }
    EXPECT_EQ(error_of("large.assbin"), "");
}

} // namespace
} // namespace foam::test
