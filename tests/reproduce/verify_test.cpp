// foam verify: what is equal, what differs, and where it began.
#include "fixture.hpp"

#include <fstream>

namespace foam::test {
namespace {

using json = nlohmann::ordered_json;
using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::StartsWith;

class Verify : public Reproduce {
protected:
    void SetUp() override {
        Reproduce::SetUp();
        must("run two.yaml --fresh --run-dir out");
    }
    json verify_json(int code = 1) const {
        const Outcome outcome = foam("verify out --json");
        EXPECT_EQ(outcome.code, code) << outcome.err;
        return json::parse(outcome.out);
    }
    /// The manifest's digest of a stage of a link, changed; returns what it was.
    std::string change_stage(std::size_t link, std::size_t stage) const {
        json m = manifest("out");
        const std::string before = m["links"][link]["stages"][stage]["output"];
        m["links"][link]["stages"][stage]["output"] = std::string(32, '0');
        write_manifest("out", m);
        return before;
    }
};

TEST_F(Verify, AnUntouchedRunIsEqual) {
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, MatchesRegex("out: equal: [0-9]+ digests of settings, inputs, stages and files; pictures "
                                          "and timings are not compared\n"));
    EXPECT_EQ(foam("verify out -j1").code, 0);
    EXPECT_EQ(verify_json(0)["differences"], json::array());
}

TEST_F(Verify, EveryStageOfEveryLinkHasADigest) {
    std::vector<std::string> stages;
    const json m = manifest("out");
    for (const json& link : m["links"]) {
        for (const json& stage : link["stages"]) {
            stages.push_back(link["link"].get<std::string>() + " " + stage["stage"].get<std::string>());
            EXPECT_THAT(stage["output"].get<std::string>(), MatchesRegex("[0-9a-f]{32}")) << stages.back();
        }
    }
    EXPECT_THAT(stages, ::testing::ElementsAre("base load.mesh", "base simplify.quadric", "base smooth.humphrey",
                                               "base spherize.grid", "base cover", "base measure", "tip spherize.grid",
                                               "tip cover", "tip measure"));
}

TEST_F(Verify, NamesTheFirstStageOfTheFirstLinkThatDiffers) {
    change_stage(1, 0);
    const std::string before = change_stage(0, 2);
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "out: differs from its manifest\n"
                           "first difference: link 'base', stage 'smooth.humphrey', 'bumpy.obj'\n"
                           "  expected 00000000000000000000000000000000\n"
                           "  found    " +
                               before +
                               "\nand 1 more:\n"
                               "  link 'tip', stage 'spherize.grid', 'cylinder'\n");
}

TEST_F(Verify, ADamagedCacheIsNotRead) {
    must("run two.yaml --run-dir out"); // fills the cache
    ASSERT_EQ(shell("find cache -type f -exec truncate -s 20 {} +").code, 0);
    EXPECT_EQ(foam("verify out").code, 0);
}

TEST_F(Verify, FindsChangedTruncatedAndMissingFiles) {
    std::ofstream(path() / "out/two.csv", std::ios::app) << "\n";
    std::filesystem::resize_file(path() / "out/two.json", 100);
    std::filesystem::remove(path() / "out/two.urdf");
    const json differences = verify_json()["differences"];
    ASSERT_EQ(differences.size(), 3u);
    const char* files[] = {"two.urdf", "two.json", "two.csv"};
    const char* found[] = {"nothing: the file is missing", "(100 bytes: the file was truncated)",
                           "bytes: the file was changed)"};
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(differences[i]["stage"], "file in the run directory");
        EXPECT_EQ(differences[i]["place"], files[i]);
        EXPECT_THAT(differences[i]["found"].get<std::string>(), HasSubstr(found[i]));
    }
}

TEST_F(Verify, FindsADebugMeshThatWasChanged) {
    write("out/links/base/00-original.ply", "ply\n");
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("first difference: file in the run directory, 'links/base/00-original.ply'\n"));
}

TEST_F(Verify, AChangedInputComesFirst) {
    std::string mesh = bumpy_obj();
    mesh.replace(mesh.find("0.11"), 4, "0.13");
    write("bumpy.obj", mesh);
    const json differences = verify_json()["differences"];
    EXPECT_EQ(differences[0]["stage"], "mesh file");
    EXPECT_EQ(differences[0]["place"], "bumpy.obj");
    EXPECT_EQ(differences[1]["link"], "base");
    EXPECT_EQ(differences[1]["stage"], "load.mesh");
}

TEST_F(Verify, AMissingInputIsSaidWithThePlacesTried) {
    std::filesystem::remove(path() / "two.urdf");
    const json differences = verify_json()["differences"];
    ASSERT_EQ(differences.size(), 2u);
    EXPECT_EQ(differences[0]["stage"], "input file");
    EXPECT_EQ(differences[0]["place"], "two.urdf");
    EXPECT_THAT(differences[0]["found"].get<std::string>(), HasSubstr("two.urdf] exists. Looked at:"));
    EXPECT_EQ(differences[1]["stage"], "run");
}

/// A run whose robot lies in a package, which is then not on the path any more.
TEST_F(Verify, APackageThatIsNotOnThePathIsNamedWithWhatToSet) {
    std::filesystem::create_directories(path() / "packages/two_description");
    std::filesystem::rename(path() / "bumpy.obj", path() / "packages/two_description/bumpy.obj");
    std::filesystem::rename(path() / "two.urdf", path() / "packages/two_description/two.urdf");
    std::string recipe = two_links_recipe;
    recipe.replace(recipe.find("two.urdf"), 8, "[package://two_description/two.urdf, other.urdf]");
    write("two.yaml", recipe);
    write("other.urdf", "<robot name=\"two\"><link name=\"base\"><collision><geometry><sphere radius=\"1\"/>"
                        "</geometry></collision></link></robot>\n");
    const std::string folder = (path() / "packages").string(), set = "FOAM_PACKAGE_PATH='" + folder + "' ";
    ASSERT_EQ(shell(set + "'" FOAM_TEST_BINARY "' run two.yaml --fresh --run-dir packed").code, 0);
    EXPECT_EQ(shell(set + "'" FOAM_TEST_BINARY "' verify packed").code, 0);

    const std::string place = "input: the run found 'package://two_description/two.urdf' at " + folder +
                              "/two_description/two.urdf; remedy: FOAM_PACKAGE_PATH=" + folder + "\n";
    const Outcome other = foam("verify packed");
    EXPECT_EQ(other.code, 1);
    EXPECT_THAT(other.out, HasSubstr("first difference: input file, 'two.urdf'\n"));
    EXPECT_THAT(other.out, HasSubstr("likely reasons:\n  " + place));
    std::filesystem::remove(path() / "other.urdf");
    const Outcome none = foam("verify packed");
    EXPECT_EQ(none.code, 1);
    EXPECT_THAT(none.out, ::testing::EndsWith("likely reasons:\n  " + place));
    const Outcome locked = foam("run --locked packed/manifest.json two.yaml --run-dir again");
    EXPECT_EQ(locked.code, 2);
    EXPECT_THAT(locked.err, HasSubstr("  " + place));

    std::filesystem::rename(path() / "packages", path() / "moved");
    EXPECT_THAT(foam("verify packed").out,
                HasSubstr("; remedy: set FOAM_PACKAGE_PATH to the folder that holds the package here\n"));
}

TEST_F(Verify, AMeshThatCannotBeReadAnyMoreIsNamedBeforeTheFailure) {
    write("bumpy.obj", "v 0 0\n");
    const json differences = verify_json()["differences"];
    ASSERT_EQ(differences.size(), 2u);
    EXPECT_EQ(differences[0]["stage"], "mesh file");
    EXPECT_EQ(differences[0]["place"], "bumpy.obj");
    EXPECT_EQ(differences[1]["stage"], "run");
    EXPECT_EQ(differences[1]["expected"], "a finished run");
    EXPECT_THAT(differences[1]["found"].get<std::string>(), HasSubstr("bumpy.obj"));
}

TEST_F(Verify, AChangedRecipeIsADifferentSetting) {
    std::string recipe = contents(path() / "out/recipe.resolved.yaml");
    const std::string before = "iterations: 3";
    recipe.replace(recipe.find(before), before.size(), "iterations: 4");
    write("out/recipe.resolved.yaml", recipe);
    const json result = verify_json();
    EXPECT_EQ(result["differences"][0], json({{"link", ""},
                                              {"stage", "setting"},
                                              {"place", "stages[1].smooth.humphrey.iterations"},
                                              {"expected", "3"},
                                              {"found", "4"}}));
    EXPECT_EQ(result["differences"][1]["stage"], "smooth.humphrey");
}

TEST_F(Verify, OtherVersionsAreLikelyReasons) {
    change_stage(0, 1);
    json m = manifest("out");
    m["foam_version"] = "0.0.1";
    m["libraries"]["eigen"] = "1.2.3";
    for (json& plugin : m["plugins"]) {
        if (plugin["plugin"] == "smooth") {
            plugin["version"] = "0.9";
        } else if (plugin["plugin"] == "simplify_quadric") {
            plugin["build"] = std::string(32, '0');
        }
    }
    write_manifest("out", m);
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.out, HasSubstr("likely reasons:\n  foam: the manifest has 0.0.1, this is "));
    EXPECT_THAT(outcome.out, MatchesRegex(".*\n  plugin simplify_quadric [0-9.]+: another build of it \\(the manifest "
                                          "has 0{32}, this is [0-9a-f]{32}\\)\n.*"));
    EXPECT_THAT(outcome.out, HasSubstr("\n  plugin smooth: the manifest has 0.9, this is "));
    EXPECT_THAT(outcome.out, HasSubstr("\n  library eigen: the manifest has 1.2.3, this is "));
}

TEST_F(Verify, APluginThatIsNotThereIsNamed) {
    json m = manifest("out");
    m["plugins"].push_back({{"plugin", "spherize_gone"}, {"version", "2.1"}, {"license", "MIT"}, {"build", nullptr}});
    write_manifest("out", m);
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(
        outcome.err,
        "foam: error: out/manifest.json: the run needs plugins that are not loaded here:\n"
        "  spherize_gone 2.1\n"
        "remedy: install them, or name them with --plugin; `foam plugins --why` shows why plugins were refused\n");
}

/// What makes a folder no run directory, and what is said.
TEST_F(Verify, WhatIsNoRunDirectory) {
    std::filesystem::create_directory(path() / "empty");
    const std::pair<const char*, const char*> cases[] = {
        {"none", "none: there is no such folder; name a folder that `foam run` made"},
        {"two.yaml", "two.yaml: this is not a folder; name a folder that `foam run` made"},
        {"empty", "empty/manifest.json: there is no such file; a run directory has one: name a folder that `foam run` "
                  "made"}};
    for (const auto& [folder, message] : cases) {
        const Outcome outcome = foam(std::string("verify ") + folder);
        EXPECT_EQ(outcome.code, 2) << folder;
        EXPECT_EQ(outcome.err, std::string("foam: error: ") + message + "\n");
        EXPECT_EQ(outcome.out, "");
    }
}

TEST_F(Verify, ADamagedManifestIsRefused) {
    const std::string whole = contents(path() / "out/manifest.json");
    const json good = json::parse(whole);
    const auto without = [&](const char* pointer) { // an RFC 6901 path
        return good.patch(json::array({{{"op", "remove"}, {"path", pointer}}})).dump();
    };
    json text_for_bytes = good, other_format = good;
    text_for_bytes["outputs"][0]["bytes"] = "many";
    other_format["foam_manifest"] = 2;
    const std::pair<std::string, const char*> cases[] = {
        {"", "it is empty"},
        {whole.substr(0, whole.size() / 2), "parse error at line "},
        {"[]", "it has no 'foam_manifest': it is not the manifest of a run"},
        {other_format.dump(), "it has format 2, this foam reads format 1"},
        {without("/plugins"), "in 'plugins': key 'plugins' not found"},
        {without("/plugins/0/version"), "in 'plugins': key 'version' not found"},
        {without("/settings/name"), "in 'settings': key 'name' not found"},
        {without("/links/0/stages/1/output"), "in 'links': key 'output' not found"},
        {text_for_bytes.dump(), "in 'outputs': type must be number, but is string"}};
    for (const auto& [text, message] : cases) {
        write("out/manifest.json", text);
        const Outcome outcome = foam("verify out");
        EXPECT_EQ(outcome.code, 2) << message;
        EXPECT_THAT(outcome.err,
                    StartsWith(std::string("foam: error: out/manifest.json: the manifest is damaged: ") + message));
        EXPECT_THAT(outcome.err,
                    HasSubstr("; remedy: restore it from where it was published, or run its recipe again\n"));
    }
}

TEST_F(Verify, WithoutItsRecipeThereIsARemedy) {
    std::filesystem::remove(path() / "out/recipe.resolved.yaml");
    const Outcome outcome = foam("verify out");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err,
              "foam: error: out/recipe.resolved.yaml: there is no such file, and without it the run cannot be "
              "repeated; remedy: `foam run --locked out/manifest.json RECIPE` with the recipe that was published\n");
}

} // namespace
} // namespace foam::test
