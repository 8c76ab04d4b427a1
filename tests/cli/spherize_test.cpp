// spherize: a mesh or robot without a recipe.
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class CliSpherize : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("box.urdf", "<robot name=\"b\">\n  <!-- kept -->\n  <link name=\"base\"><collision><geometry><mesh "
                          "filename=\"box.obj\"/>"
                          "</geometry></collision></link>\n</robot>\n");
    }
};

TEST_F(CliSpherize, AMeshGivesJsonByDefault) {
    const Outcome outcome = foam("spherize box.obj -n 3 --method grid");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Written: box_spheres.json ("));
    EXPECT_TRUE(json::accept(contents(path() / "box_spheres.json")));
    EXPECT_FALSE(std::filesystem::exists(path() / "runs"));
}

TEST_F(CliSpherize, APipeOrALinkStays) {
    const Outcome pipe = shell("mkfifo pipe.csv && { timeout 30 cat pipe.csv > got.csv & } && '" FOAM_TEST_BINARY
                               "' spherize box.obj -n 3 --method grid -o pipe.csv && wait");
    ASSERT_EQ(pipe.code, 0) << pipe.err;
    EXPECT_TRUE(std::filesystem::is_fifo(path() / "pipe.csv")) << "-o /dev/null must not replace the device";
    write("old.csv", "old");
    std::filesystem::create_symlink("old.csv", path() / "link.csv");
    ASSERT_EQ(foam("spherize box.obj -n 3 --method grid -o link.csv").code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path() / "link.csv"));
    std::filesystem::create_symlink("new.csv", path() / "dangling.csv");
    ASSERT_EQ(foam("spherize box.obj -n 3 --method grid -o dangling.csv").code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path() / "dangling.csv"));
    EXPECT_EQ(contents(path() / "new.csv"), contents(path() / "got.csv"));
    std::filesystem::create_symlink("round.csv", path() / "round.csv");
    EXPECT_THAT(foam("spherize box.obj -n 3 --method grid -o round.csv").err, HasSubstr("Too many levels"));
    EXPECT_THAT(contents(path() / "got.csv"), StartsWith("link,x,y,z"));
    EXPECT_EQ(contents(path() / "old.csv"), contents(path() / "got.csv"));
}

TEST_F(CliSpherize, ToolFramesAreOptions) {
    write(
        "arm.urdf",
        "<robot name=\"r\"><link name=\"base\"><collision><geometry><mesh filename=\"box.obj\"/></geometry></collision>"
        "</link><link name=\"arm\"/><joint name=\"j\" type=\"revolute\"><parent link=\"base\"/><child link=\"arm\"/>"
        "<axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint></robot>\n");
    const std::string curobo = "spherize arm.urdf -n 3 --method grid --format curobo -o arm.yml";
    const Outcome outcome = foam(curobo + " --tool-frame arm");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(contents(path() / "arm.yml"), ::testing::ContainsRegex("tool_frames: *\n? *[-[] ?arm"));
    EXPECT_THAT(foam(curobo + " --tool-frame ar").err, HasSubstr("names no link of arm.urdf; did you mean 'arm'?"));
}

TEST_F(CliSpherize, AUrdfGivesAUrdfByDefault) {
    const Outcome outcome = foam("spherize box.urdf -n 3 --method spherize.grid");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string urdf = contents(path() / "box_spheres.urdf");
    EXPECT_THAT(urdf, HasSubstr("<!-- kept -->"));
    EXPECT_THAT(urdf, HasSubstr("<sphere radius="));
}

TEST_F(CliSpherize, TheEndingSaysTheFormat) {
    ASSERT_EQ(foam("spherize box.obj -n 3 --method grid -o out.csv --json").code, 0);
    EXPECT_THAT(contents(path() / "out.csv"), StartsWith("link,x,y,z,radius\n"));
    const Outcome none = foam("spherize box.obj -o out");
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err, HasSubstr("remedy: -o out.json, or --format"));
    const Outcome unknown = foam("spherize box.obj -o out.docx");
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("no format 'docx'; there are: "));
}

TEST_F(CliSpherize, DataToStandardOutput) {
    const Outcome outcome = foam("spherize box.obj -n 3 --method grid -o - --format csv");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, StartsWith("link,x,y,z,radius\n"));
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4);
    EXPECT_THAT(outcome.err, HasSubstr("total"));
    EXPECT_EQ(foam("spherize box.obj -o -").code, 2) << "no format";
}

TEST_F(CliSpherize, ThePrintedRecipeGivesTheSame) {
    const Outcome printed = foam("spherize box.obj -n 5 --method grid --print-recipe");
    ASSERT_EQ(printed.code, 0) << printed.err;
    EXPECT_THAT(printed.out, HasSubstr("- spherize.grid: {}\n"));
    EXPECT_THAT(printed.out, HasSubstr("budget: {spheres: 5}"));
    EXPECT_THAT(foam("spherize box.obj -n 5 --excess 0.5 --max-protrusion 0.01 --print-recipe").out,
                HasSubstr("budget: {spheres: 5, excess: 0.5, max_protrusion: 0.01} "));
    EXPECT_FALSE(std::filesystem::exists(path() / "box_spheres.json"));
    write("printed.yaml", printed.out);
    ASSERT_EQ(foam("run printed.yaml").code, 0);
    ASSERT_EQ(foam("spherize box.obj -n 5 --method grid").code, 0);
    EXPECT_EQ(contents(path() / "runs/box_spheres/box_spheres.json"), contents(path() / "box_spheres.json"));
}

TEST_F(CliSpherize, TheRunDirectoryIsKeptIfAskedFor) {
    ASSERT_EQ(foam("spherize box.obj -n 3 --method grid -o out.csv --run-dir kept").code, 0);
    EXPECT_TRUE(std::filesystem::exists(path() / "kept/manifest.json"));
    EXPECT_TRUE(std::filesystem::exists(path() / "out.csv"));
}

TEST_F(CliSpherize, AsFewSpheresAsAnExcessTakes) {
    const Outcome enough = foam("spherize box.obj --excess 1 --method grid -o out.csv");
    EXPECT_EQ(enough.code, 0) << enough.err;
    const Outcome wrong = foam("spherize box.obj --excess 0 --method grid -o none.csv");
    EXPECT_EQ(wrong.code, 2);
    EXPECT_THAT(wrong.err, HasSubstr("'excess' of budget expects a number between 1e-06 and 1000000, got 0"));
    EXPECT_FALSE(std::filesystem::exists(path() / "none.csv"));
}

TEST_F(CliSpherize, OptionsForEffortObjectiveAndSeedAreSettings) {
    const std::string printed =
        foam("spherize box.obj -n 3 --effort fast --objective protrusion --seed 7 --print-recipe").out;
    EXPECT_THAT(printed, AllOf(HasSubstr("effort: fast"), HasSubstr("objective: protrusion"), HasSubstr("seed: 7")));
    EXPECT_THAT(foam("spherize box.obj -n 3 -m grid --effort fast").err,
                AllOf(HasSubstr("spherize.grid has no effort"), HasSubstr("remedy")));
    EXPECT_EQ(foam("spherize box.obj -n 3 --effort slow").code, 2);
}

TEST_F(CliSpherize, QuietIsSilent) {
    const Outcome outcome = foam("spherize box.obj -n 3 -q");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    EXPECT_TRUE(std::filesystem::exists(path() / "box_spheres.json"));
    EXPECT_EQ(foam("spherize box.obj -n 3 -q -v").code, 2);
}

TEST_F(CliSpherize, ATimeLimitGivesWhatThereIs) {
    const Outcome outcome = foam("spherize box.obj -n 64 --method grid --fresh --time-limit 0.0001 -o out.json --json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("warning: the search ended at its time limit of 0.0001 s: these are the best "
                                       "elements so far; another run may give others\n"));
    EXPECT_THAT(outcome.out, HasSubstr("\"cut\": \"time limit\""));
    EXPECT_THAT(outcome.out, HasSubstr("\"certified\": true"));
    EXPECT_TRUE(std::filesystem::exists(path() / "out.json"));
    EXPECT_EQ(foam("spherize box.obj --time-limit 0").code, 2);
}

TEST_F(CliSpherize, ErrorsNameTheCause) {
    const Outcome missing = foam("spherize none.stl");
    EXPECT_EQ(missing.code, 1);
    EXPECT_EQ(missing.err, "foam: error: none.stl: there is no such file; remedy: check the path\n");
    const Outcome method = foam("spherize box.obj --method gird");
    EXPECT_EQ(method.code, 2);
    EXPECT_THAT(method.err, HasSubstr("unknown method 'gird'; did you mean 'grid'?; there are: "));
    const Outcome folder = foam("spherize box.obj -n 3 --method grid -o none/out.csv");
    EXPECT_EQ(folder.code, 1);
    EXPECT_THAT(folder.err, HasSubstr("there is no folder none"));
}

TEST_F(CliSpherize, AFailureLeavesTheOldResult) {
    write("box_spheres.json", "old");
    write("box.obj", "v 0 0 0\n");
    const Outcome outcome = foam("spherize box.obj");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("there are no triangles in it, only 1 points"));
    EXPECT_EQ(contents(path() / "box_spheres.json"), "old");
    for (const auto& entry : std::filesystem::directory_iterator(path())) {
        EXPECT_NE(entry.path().filename().string().rfind(".foam-", 0), 0u) << "a scratch folder is left";
    }
}

} // namespace
} // namespace foam::test
