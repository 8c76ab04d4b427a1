// foam run --locked: the run of a manifest, or none.
#include "fixture.hpp"

#include <fstream>

namespace foam::test {
namespace {

using json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class Locked : public Reproduce {
protected:
    void SetUp() override {
        Reproduce::SetUp();
        must("run two.yaml --fresh --run-dir made");
        std::filesystem::copy_file(path() / "made/manifest.json", path() / "manifest.json");
    }
    /// Standard error of a run that is refused.
    std::string refusal(int code, const std::string& more = "") const {
        const Outcome outcome = foam("run --locked manifest.json two.yaml --run-dir again " + more);
        EXPECT_EQ(outcome.code, code);
        EXPECT_FALSE(std::filesystem::exists(path() / "again"));
        return outcome.err;
    }
};

TEST_F(Locked, TheSameRunIsMade) {
    must("run --locked manifest.json two.yaml --fresh --run-dir again");
    expect_same("made", "again");
}

TEST_F(Locked, WithoutARecipeTheResolvedOneIsTaken) {
    must("run --locked made/manifest.json --run-dir again");
    must("run --locked made --run-dir folder");
    expect_same("made", "again");
    expect_same("made", "folder");
    const Outcome none = foam("run --locked manifest.json");
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err, HasSubstr("recipe.resolved.yaml"));
}

TEST_F(Locked, PlacesAndDebugMeshesMayDiffer) {
    const std::string reader = "cd reader && '" FOAM_TEST_BINARY "' run --locked manifest.json two.yaml --run-dir ";
    ASSERT_EQ(shell("mkdir reader && mv bumpy.obj two.urdf two.yaml manifest.json reader").code, 0);
    EXPECT_EQ(shell(reader + "../without --set debug.meshes=false").code, 0);
    EXPECT_EQ(contents(path() / "without/two.json"), contents(path() / "made/two.json"));
    EXPECT_EQ(shell(reader + "../again").code, 0);
    expect_same("made", "again");
}

TEST_F(Locked, AllThatDiffersIsSaidAtOnce) {
    json m = manifest("made");
    m["foam_version"] = "0.0.1";
    for (json& plugin : m["plugins"]) {
        if (plugin["plugin"] == "smooth") {
            plugin["version"] = "0.9";
        }
    }
    m["plugins"].push_back({{"plugin", "spherize_gone"}, {"version", "2.1"}, {"license", "MIT"}, {"build", nullptr}});
    write("manifest.json", m.dump());
    std::ofstream(path() / "bumpy.obj", std::ios::app) << "# other bytes\n";
    EXPECT_THAT(
        refusal(2, "--set budget.spheres=8 --set stages.simplify.quadric.ratio=0.25"),
        MatchesRegex("foam: error: this would not be the run of manifest.json:\n"
                     "  foam: the manifest has 0.0.1, this is [0-9.]+\n"
                     "  plugin smooth: the manifest has 0.9, this is [0-9.]+\n"
                     "  plugin spherize_gone: the manifest has 2.1, it is not loaded\n"
                     "  setting stages\\[0\\].simplify.quadric.ratio: the manifest has 0.5, the recipe has 0.25\n"
                     "  setting budget.spheres: the manifest has 9, the recipe has 8\n"
                     "  mesh file bumpy.obj: the manifest has [0-9a-f]{32}, here is [0-9a-f]{32} "
                     "\\(.*/bumpy.obj\\)\n"
                     "remedy: install the versions of the manifest; take the recipe of the manifest, without "
                     "changes by --set; take the inputs of the manifest \\(FOAM_PACKAGE_PATH names the folders "
                     "of packages\\); or run without --locked for a result of your own\n"));
}

TEST_F(Locked, AMissingMeshIsADifference) {
    std::filesystem::remove(path() / "bumpy.obj");
    EXPECT_THAT(refusal(2), MatchesRegex("foam: error: this would not be the run of manifest.json:\n"
                                         "  mesh file bumpy.obj: the manifest has [0-9a-f]+, here is nothing\n(.*\n)*"));
}

TEST_F(Locked, PluginsAloneHaveTheirExitCode) {
    json m = manifest("made");
    m["plugins"][0]["version"] = "0.9";
    write("manifest.json", m.dump());
    EXPECT_THAT(refusal(3), HasSubstr(": the manifest has 0.9, this is "));
}

TEST_F(Locked, APluginThatTheRecipeNeedsAndIsNotThere) {
    json m = manifest("made");
    m["plugins"].push_back({{"plugin", "spherize_gone"}, {"version", "2.1"}, {"license", "MIT"}, {"build", nullptr}});
    write("manifest.json", m.dump());
    std::string recipe = two_links_recipe;
    recipe.replace(recipe.find("spherize.grid"), 13, "spherize.gone");
    write("two.yaml", recipe);
    EXPECT_THAT(refusal(3), HasSubstr("\n  plugin spherize_gone: the manifest has 2.1, it is not loaded\n"));
}

TEST_F(Locked, OtherOutputsAreNotPublished) {
    json m = manifest("made");
    m["outputs"][1]["digest"] = std::string(32, '0');
    m["links"][0]["stages"][2]["output"] = std::string(32, '0');
    m["libraries"]["glibc"] = "1.0";
    write("manifest.json", m.dump());
    EXPECT_THAT(refusal(1),
                MatchesRegex("(.*\n)*foam: error: the outputs are not those of manifest.json; nothing was written:\n"
                             "  two.json: the manifest has 0{32}, this run made [0-9a-f]{32}\n"
                             "first difference: link 'base', stage 'smooth.humphrey', 'bumpy.obj'\n"
                             "likely reason: library glibc: the manifest has 1.0, this is [0-9.]+\n"
                             "remedy: install what the manifest names; or run without --locked for a result of your "
                             "own\n"));
}

TEST_F(Locked, OfASweepTheRunOfTheManifestIsTaken) {
    std::string recipe = two_links_recipe;
    recipe += "sweep: {budget.spheres: [5, 6]}\n";
    write("sweep.yaml", recipe);
    must("run sweep.yaml --run-dir swept");
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path() / "swept")) {
        names.push_back(entry.path().filename().string());
    }
    ASSERT_EQ(names.size(), 2u);
    for (const std::string& name : names) {
        must("run --locked swept/" + name + "/manifest.json sweep.yaml --run-dir again/" + name);
        expect_same("swept/" + name, "again/" + name);
    }
    const Outcome other = foam("run --locked manifest.json sweep.yaml --run-dir again");
    EXPECT_EQ(other.code, 2);
    EXPECT_EQ(other.err, "foam: error: manifest.json is of a run 'two', which is not among those of the recipe\n");
}

TEST_F(Locked, ARecipeIsNeededWithoutALock) {
    const Outcome outcome = foam("run");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "foam: error: recipe is required; `foam run --help` explains its use\n");
}

} // namespace
} // namespace foam::test
