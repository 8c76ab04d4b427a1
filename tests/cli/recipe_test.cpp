// check and run.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* recipe = "foam: 1\n"
                               "name: box\n"
                               "mesh: [box.obj]\n"
                               "stages:\n"
                               "  - spherize.grid: {}\n"
                               "budget: {spheres: 4}\n"
                               "outputs:\n"
                               "  - write.csv: {file: box.csv}\n";

class CliRecipe : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("box.yaml", recipe);
    }
};

TEST_F(CliRecipe, CheckOfAGoodOne) {
    const Outcome outcome = foam("check box.yaml");
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "foam: box.yaml: valid, 1 run\n");
}

TEST_F(CliRecipe, CheckOfABadOneSaysAllWithPlaces) {
    write("bad.yaml", "foam: 1\nmesh: [box.obj]\nstagse: []\nbudget: {spheres: many}\n");
    const Outcome outcome = foam("check bad.yaml");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.out, HasSubstr("bad.yaml:3:1: error[unknown-key]"));
    EXPECT_THAT(outcome.out, HasSubstr("bad.yaml:4:19: error[wrong-type]"));
    const Outcome data = foam("check bad.yaml --json");
    EXPECT_EQ(data.code, 2);
    const json findings = json::parse(data.out);
    EXPECT_FALSE(findings["ok"].get<bool>());
    ASSERT_FALSE(findings["findings"].empty());
    for (const json& finding : findings["findings"]) {
        EXPECT_EQ(finding["file"], "bad.yaml");
        EXPECT_THAT(data.out, HasSubstr(finding["code"].get<std::string>()));
    }
}

TEST_F(CliRecipe, ParametersOfLoadersReachThem) {
    write("small.yaml", std::string(recipe) + "loaders: {load.mesh: {max_triangles: 3}}\n");
    const std::string reason =
        "box.obj: more than 3 triangles; remedy: simplify the mesh, or raise max_triangles of load.mesh";
    for (const char* isolation : {"none", "process"}) {
        const Outcome outcome = foam(std::string("run small.yaml --set isolate=") + isolation);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_THAT(outcome.err, HasSubstr(reason));
    }
}

TEST_F(CliRecipe, UnknownStage) {
    write("bad.yaml", "foam: 1\nmesh: [box.obj]\nstages:\n  - spherize.gird: {}\n");
    const Outcome outcome = foam("run bad.yaml");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("bad.yaml:4:5: error[unknown-stage]"));
    EXPECT_THAT(outcome.err, HasSubstr("nothing was run"));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs"));
}

TEST_F(CliRecipe, MissingRecipe) {
    const Outcome outcome = foam("run none.yaml");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("none.yaml: error[cannot-read]: there is no such file"));
}

TEST_F(CliRecipe, OneThatComesWithFoamByName) {
    const Outcome check = foam("check panda_11");
    EXPECT_EQ(check.code, 0) << check.out << check.err;
    EXPECT_EQ(check.err, "foam: panda_11: valid, 1 run\n");
    std::filesystem::create_directory(path() / "panda_11"); // as `--out panda_11` does
    const Outcome run = foam("run panda_11");
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/panda_11/manifest.json"));
    EXPECT_EQ(foam("plan panda_11").code, 0);
}

TEST_F(CliRecipe, AFileComesBeforeOneThatComesWithFoam) {
    write("panda_11", recipe);
    EXPECT_THAT(foam("plan panda_11").out, HasSubstr("box.csv"));
}

TEST_F(CliRecipe, ANameThatNoRecipeHas) {
    for (const std::string command : {"check", "plan", "run"}) {
        const Outcome outcome = foam(command + " panda_12");
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.err,
                  "foam: error: panda_12: there is no such file, and no recipe of this name comes with "
                  "foam; remedy: check the path, or name one of panda_11, panda_22, panda_22_medial, panda_27, "
                  "panda_316, panda_92, panda_sweep; did you mean 'panda_11'?\n");
    }
}

TEST_F(CliRecipe, RunWritesItsFolderAndPrintsATable) {
    const Outcome outcome = foam("run box.yaml");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("foam: box: input box.obj (", 0), 0u) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("link   spheres    excess    gap mm  certified  growth mm\nbox          4 "));
    EXPECT_THAT(outcome.out, HasSubstr("Proved: "));
    EXPECT_THAT(outcome.out, HasSubstr("Written to runs/box: box.csv"));
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/box/box.csv"));
    EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "a progress bar though stderr is no terminal";
}

/// Pictures of links are many: only debug draws them. A line says how long pictures took beside the spheres.
TEST_F(CliRecipe, SnapshotsDrawTheWholeAndDebugTheLinks) {
    const Outcome whole = foam("run box.yaml --set snapshots.size=[80,60]");
    ASSERT_EQ(whole.code, 0) << whole.err;
    EXPECT_THAT(whole.out,
                ::testing::ContainsRegex("\nTime: [0-9.]+ s .spheres [0-9.]+ s, pictures [0-9.]+ s., CPU [0-9.]+ s\n"));
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/box/snapshots/robot.png"));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/box/links/box/spheres.png"));
    ASSERT_EQ(foam("run box.yaml --set snapshots.size=[80,60] --set debug.snapshots=true").code, 0);
    const std::string png = contents(path() / "runs/box/links/box/spheres.png");
    ASSERT_GT(png.size(), 24u);
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\0\x28\0\0\0\x1e", 8)) << "40 x 30 pixels";
    EXPECT_TRUE(std::filesystem::exists(path() / "runs/box/links/box/stages.png"));
}

TEST_F(CliRecipe, RunWithSettingsFolderAndJson) {
    const Outcome outcome = foam("run box.yaml --set budget.spheres=2 --run-dir here -j 2 --fresh --json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json data = json::parse(outcome.out)["runs"][0];
    EXPECT_EQ(data["directory"], "here");
    EXPECT_EQ(data["total"]["spheres"], 2);
    EXPECT_TRUE(data["certified"].get<bool>());
    EXPECT_TRUE(std::filesystem::exists(path() / "here/box.csv"));
}

TEST_F(CliRecipe, ASweepHasAFolderForEachPoint) {
    std::string swept = recipe;
    swept.erase(swept.find("budget"), swept.find("outputs") - swept.find("budget"));
    write("sweep.yaml", swept + "sweep: {budget.spheres: [1, 3]}\n");
    const Outcome good = foam("run sweep.yaml --run-dir points --json");
    const json runs = json::parse(good.code == 0 ? good.out : "{\"runs\":[]}")["runs"];
    ASSERT_EQ(runs.size(), 2u) << good.err;
    EXPECT_EQ(runs[0]["total"]["spheres"], 1);
    EXPECT_EQ(runs[1]["total"]["spheres"], 3);
    for (const json& run : runs) {
        EXPECT_TRUE(std::filesystem::exists(path() / run["directory"].get<std::string>() / "box.csv"));
    }
}

/// Over box.yaml: a file in another folder, a variant, a sweep, values by path.
constexpr const char* composed = "foam: 1\n"
                                 "extends: ../box.yaml\n"
                                 "set: {stages.spherize.grid.refine: false}\n"
                                 "links: {'b*': {min_spheres: 2}}\n"
                                 "isolate: process\n"
                                 "sweep: {seed: [1, 2]}\n"
                                 "variants:\n"
                                 "  small: {budget.spheres: 3}\n"
                                 "  alone: {sweep: null}\n";

TEST_F(CliRecipe, CheckNamesTheVariants) {
    std::filesystem::create_directory(path() / "mine");
    write("mine/composed.yaml", composed);
    const Outcome good = foam("check mine/composed.yaml");
    EXPECT_EQ(good.code, 0) << good.out;
    EXPECT_EQ(good.err, "foam: mine/composed.yaml: valid, 2 runs; variants: small, alone\n");
    const json data = json::parse(foam("check mine/composed.yaml --variant '*' --json").out);
    EXPECT_EQ(data["runs"], json({"composed-small-seed=1", "composed-small-seed=2", "composed-alone"}));
    EXPECT_EQ(data["variants"], json({"small", "alone"}));
    const Outcome unknown = foam("run mine/composed.yaml --variant smal");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_EQ(unknown.err, "--variant:1:1: error[unknown-variant]: the recipe has no variant 'smal'; did you mean "
                           "'small'?\nfoam: error: mine/composed.yaml: 1 error in the recipe; nothing was run\n");
}

TEST_F(CliRecipe, VariantsHaveFoldersOfTheirOwnAndTheManifestNamesEveryFile) {
    std::filesystem::create_directory(path() / "mine");
    write("mine/composed.yaml", composed);
    const Outcome outcome = foam("run mine/composed.yaml --variant small --variant alone");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* name : {"composed-small-seed=1", "composed-small-seed=2", "composed-alone"}) {
        const auto folder = path() / "runs" / name;
        EXPECT_TRUE(std::filesystem::exists(folder / "box.csv")) << name;
        const json manifest = json::parse(contents(folder / "manifest.json"));
        EXPECT_EQ(manifest["execution"]["recipe"]["file"], "mine/composed.yaml");
        EXPECT_EQ(manifest["execution"]["recipe"]["extends"][0]["file"], "mine/../box.yaml");
        EXPECT_EQ(manifest["execution"]["recipe"]["extends"][0]["digest"].get<std::string>().size(), 32u);
        EXPECT_EQ(manifest["execution"]["recipe"]["variant"], std::string(name).find("small") == 9 ? "small" : "alone");
    }
}

/// However a recipe was put together, what it came to is one plain file that gives the same bytes from anywhere.
TEST_F(CliRecipe, TheResolvedRecipeRunsAgainToTheSameDigests) {
    std::filesystem::create_directories(path() / "mine");
    std::filesystem::create_directories(path() / "elsewhere");
    write("mine/composed.yaml", composed);
    ASSERT_EQ(foam("run mine/composed.yaml --variant small --run-dir first --set links.*.max_spheres=9").code, 0);
    for (const char* name : {"composed-small-seed=1", "composed-small-seed=2"}) {
        const auto first = path() / "first" / name;
        const std::string resolved = contents(first / "recipe.resolved.yaml");
        for (const char* key : {"extends:", "set:", "variants:", "sweep:"}) {
            EXPECT_EQ(resolved.find(key), resolved.npos) << resolved;
        }
        const Outcome again = shell("cd elsewhere && '" FOAM_TEST_BINARY "' run '" +
                                    (first / "recipe.resolved.yaml").string() + "' --fresh --run-dir again");
        ASSERT_EQ(again.code, 0) << again.err;
        const auto second = path() / "elsewhere/again";
        const json a = json::parse(contents(first / "manifest.json")),
                   b = json::parse(contents(second / "manifest.json"));
        EXPECT_EQ(a["outputs"], b["outputs"]);
        EXPECT_EQ(a["mesh_files"], b["mesh_files"]);
        EXPECT_EQ(contents(first / "box.csv"), contents(second / "box.csv"));
        EXPECT_EQ(contents(second / "recipe.resolved.yaml"), resolved);
        std::filesystem::remove_all(second);
    }
}

/// Only the recipe is read: its data may be missing, or be no data at all.
TEST_F(CliRecipe, CheckTouchesNoData) {
    write("box.obj", "this is no mesh");
    EXPECT_EQ(foam("check box.yaml").code, 0);
    std::filesystem::remove(path() / "box.obj");
    EXPECT_EQ(foam("check box.yaml").code, 0);
    EXPECT_FALSE(std::filesystem::exists(path() / "runs"));
    EXPECT_FALSE(std::filesystem::exists(path() / "cache"));
}

/// Two links of the same box, one of another box, one that is left out.
constexpr const char* boxes_urdf =
    "<robot name='boxes'>"
    "<link name='base'><collision><geometry><mesh filename='box.obj'/></geometry></collision></link>"
    "<link name='arm'><collision><geometry><mesh filename='box.obj'/></geometry></collision></link>"
    "<link name='hand'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
    "<link name='tool'><collision><geometry><sphere radius='1'/></geometry></collision></link>"
    "<joint name='a' type='fixed'><parent link='base'/><child link='arm'/></joint>"
    "<joint name='b' type='fixed'><parent link='arm'/><child link='hand'/></joint>"
    "<joint name='c' type='fixed'><parent link='hand'/><child link='tool'/></joint></robot>";

constexpr const char* boxes = "foam: 1\n"
                              "name: boxes\n"
                              "robot: {urdf: ['package://none/boxes.urdf', boxes.urdf]}\n"
                              "stages:\n"
                              "  - smooth.humphrey: {iterations: 0}\n"
                              "  - spherize.grid\n"
                              "links:\n"
                              "  'a*': {smooth.humphrey: {iterations: 1}}\n"
                              "  tool: {skip: true}\n"
                              "outputs: [write.csv: {file: b.csv}]\n"
                              "variants: {fine: {budget.spheres: 9}}\n";

TEST_F(CliRecipe, PlanSaysWhatWouldRunAndWritesNothing) {
    write("boxes.urdf", boxes_urdf);
    write("boxes.yaml", boxes);
    const Outcome plan = foam("plan boxes.yaml");
    ASSERT_EQ(plan.code, 0) << plan.err;
    EXPECT_EQ(plan.err, "foam: without its variants: fine; --variant selects them\n");
    const std::string expected =
        "boxes\n"
        "  recipe     boxes.yaml\n"
        "  input      boxes.urdf (" +
        (path() / "boxes.urdf").string() +
        ")\n"
        "             not found before it: package://none/boxes.urdf\n"
        "  meshes     1 by load.mesh\n"
        "  stages     smooth.humphrey {iterations: 0} (smooth 1.0)\n"
        "             spherize.grid (spherize_grid 1.0)\n"
        "  budget     determined by the spherizer's parameters; guarantee outer; seed 0\n"
        "  links      base  smooth.humphrey to do, spherize.grid to do\n"
        "             arm   smooth.humphrey to do, spherize.grid to do; changed by boxes.yaml:8:3 (a*)\n"
        "             hand  smooth.humphrey nothing to do, spherize.grid to do\n"
        "             tool  excluded by boxes.yaml:9:3 (tool)\n"
        "  outputs    b.csv by write.csv (write_csv 1.0)\n"
        "  directory  runs/boxes\n";
    EXPECT_EQ(plan.out, expected);
    EXPECT_FALSE(std::filesystem::exists(path() / "runs"));
    EXPECT_FALSE(std::filesystem::exists(path() / "cache"));
}

TEST_F(CliRecipe, PlanSaysTheWholeBudget) {
    write("boxes.urdf", boxes_urdf);
    write("boxes.yaml", boxes);
    const std::string settings =
        "plan boxes.yaml --set 'budget={spheres: 9, excess: 0.5, max_protrusion: 1e-2, time_limit: "
        "60}' --set 'links.a*.weight=2' --set 'self_collision={pose: {b: 0.1}}' ";
    const Outcome plan = foam(settings);
    ASSERT_EQ(plan.code, 0) << plan.err;
    EXPECT_THAT(plan.out,
                HasSubstr("  budget     9 spheres, excess of at most 0.5, protrusion of at most 0.01 m, the best "
                          "within 60 s; guarantee outer; seed 0\n"
                          "  apart      spheres of links that are not neighbours, with b at 0.1, others at "
                          "zero\n"));
    const std::string text = foam(settings + "--json").out;
    EXPECT_THAT(text, HasSubstr("\"spheres\": 9,\n        \"excess\": 0.5,\n        \"max_protrusion_m\": 0.01,\n"
                                "        \"time_limit_seconds\": 60.0\n"));
    EXPECT_THAT(text, HasSubstr("\"b\": 0.1\n"));
}

TEST_F(CliRecipe, PlanKnowsWhatTheCacheHolds) {
    write("boxes.urdf", boxes_urdf);
    write("boxes.yaml", boxes);
    const auto stages = [&](const std::string& arguments) {
        std::string text;
        const json plan = json::parse(foam("plan boxes.yaml --json " + arguments).out);
        for (const json& link : plan["runs"][0]["links"]) {
            for (const json& stage : link["stages"]) {
                text +=
                    std::to_string(stage["cached"].get<int>()) + "/" + std::to_string(stage["needed"].get<int>()) + " ";
            }
        }
        return text;
    };
    EXPECT_EQ(stages(""), "0/1 0/1 0/1 0/1 0/0 0/1 ");
    ASSERT_EQ(foam("run boxes.yaml").code, 0);
    EXPECT_EQ(stages(""), "1/1 1/1 1/1 1/1 0/0 1/1 ");
    EXPECT_EQ(stages("--variant fine"), "1/1 0/2 1/1 0/2 0/0 0/2 ");
    ASSERT_EQ(foam("run boxes.yaml --variant fine").code, 0);
    EXPECT_EQ(stages("--variant fine"), "1/1 2/2 1/1 2/2 0/0 2/2 ");
    // The grid looks at the original alone: other filters leave its spheres as they are.
    EXPECT_EQ(stages("--set stages.smooth.humphrey.iterations=2"), "0/1 1/1 1/1 1/1 0/0 1/1 ");
}

TEST_F(CliRecipe, PlanOfWhatCannotRun) {
    write("boxes.urdf", boxes_urdf);
    write("boxes.yaml", boxes);
    write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const Outcome bad = foam("plan boxes.yaml");
    EXPECT_EQ(bad.code, 1);
    EXPECT_THAT(bad.out, HasSubstr("base  cannot be read: "));
    EXPECT_THAT(bad.out, HasSubstr("hand  smooth.humphrey nothing to do, spherize.grid to do\n"));
    std::filesystem::remove(path() / "boxes.urdf");
    const Outcome missing = foam("plan boxes.yaml");
    EXPECT_EQ(missing.code, 1);
    EXPECT_EQ(missing.out, "");
    EXPECT_THAT(missing.err, HasSubstr("boxes.yaml:3:1: none of the inputs"));
    write("boxes.yaml", "foam: 1\n");
    EXPECT_EQ(foam("plan boxes.yaml").code, 2);
}

TEST_F(CliRecipe, MissingInputNamesThePlaces) {
    std::filesystem::remove(path() / "box.obj");
    const Outcome outcome = foam("run box.yaml");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr((path() / "box.obj").string()));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/box"));
}

TEST_F(CliRecipe, ABadMeshFailsTheStageAndLeavesNothing) {
    write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    const Outcome outcome = foam("run box.yaml");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_THAT(outcome.err, HasSubstr("box.obj:3: a coordinate of the vertex is not finite: (0, nan, 0)"));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/box"));
}

/// The signal is sent when the run has said which input it takes; the whole run takes seconds.
TEST_F(CliRecipe, InterruptLeavesNothing) {
    write("slow.yaml", "foam: 1\nname: slow\nrobot: {urdf: ['" FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf']}\n"
                       "stages: [{repair.watertight: {}}, {spherize.medial: {branch: 300}}]\n"
                       "outputs: [{write.csv: {file: s.csv}}]\n");
    const Outcome outcome = shell("'" FOAM_TEST_BINARY "' run slow.yaml --fresh & pid=$!; for i in $(seq 500); do "
                                  "grep -q input .err && break; sleep 0.02; done; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("foam: stopping; a second signal ends it at once\n"));
    EXPECT_THAT(outcome.err, HasSubstr("foam: stopped: "));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs/slow"));
}

} // namespace
} // namespace foam::test
