// `-` in the place of a mesh, a robot, a sphere model or a recipe.
#include "program.hpp"

#include <foam/sdk/abi.hpp>

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

constexpr const char* robot_urdf = R"(<robot name="box">
  <link name="base">
    <collision><geometry><mesh filename="meshes/box.obj"/></geometry></collision>
  </link>
</robot>
)";

class FromStandardInput : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        fs::create_directory(path() / "meshes");
        write("meshes/box.obj", box_obj);
        write("robot.urdf", robot_urdf);
    }
    Outcome piped(const std::string& file, const std::string& arguments) const {
        return shell("cat " + file + " | '" FOAM_TEST_BINARY "' " + arguments);
    }
};

TEST_F(FromStandardInput, AMeshGivesTheSpheresOfItsFile) {
    const Outcome outcome = piped("box.obj", "spherize - -n 3 -m grid -o piped.csv");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    ASSERT_EQ(foam("spherize box.obj -n 3 -m grid -o named.csv").code, 0);
    const auto numbers = [&](const std::string& file) {
        std::string text = contents(path() / file), rest;
        for (std::size_t at = 0; at < text.size();) { // without links: they are named after the file
            const std::size_t end = std::min(text.find('\n', at), text.size());
            const std::string line = text.substr(at, end - at);
            rest += line.substr(std::min(line.find(','), line.size())) + "\n";
            at = end + 1;
        }
        return rest;
    };
    EXPECT_EQ(numbers("piped.csv"), numbers("named.csv"));
    EXPECT_THAT(contents(path() / "piped.csv"), Not(HasSubstr("/tmp")));
}

TEST_F(FromStandardInput, AMeshIsRecognisedByItsContent) {
    const auto info = nlohmann::json::parse(piped("box.obj", "info - --json").out);
    EXPECT_EQ(info.at("kind"), "mesh");
    EXPECT_EQ(info.at("file"), "stdin");
    EXPECT_EQ(info.at("links").at(0).at("triangles"), 12);
}

TEST_F(FromStandardInput, ARobotFindsItsMeshesFromTheCurrentFolder) {
    const auto info = nlohmann::json::parse(piped("robot.urdf", "info - --json").out);
    EXPECT_EQ(info.at("kind"), "robot");
    EXPECT_EQ(info.at("links").at(0).at("triangles"), 12);
    const Outcome made = piped("robot.urdf", "spherize - -n 3 -m grid -o piped.urdf");
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_EQ(foam("spherize robot.urdf -n 3 -m grid -o named.urdf").code, 0);
    EXPECT_THAT(contents(path() / "piped.urdf"), HasSubstr("<sphere"));
    EXPECT_EQ(foam("certify robot.urdf piped.urdf").code, 0);
}

TEST_F(FromStandardInput, ARobotKeepsItsTextAndItsReferencesLeadOn) {
    write("two.urdf", R"(<?xml version='1.0'?> <!-- mine -->
<robot  name="two">
  <link name="base"><visual><geometry><mesh   filename='meshes/box.obj'/></geometry>
      <material name="m"><texture filename="skin.png"/></material></visual>
    <collision><geometry><mesh filename="meshes/box.obj"/></geometry></collision></link>
  <link name="tip"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="tip"/><origin xyz="0 0 0.5"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)");
    write("skin.png", "");
    fs::create_directory(path() / "out");
    ASSERT_EQ(piped("two.urdf", "spherize - -n 6 -m grid -o out/piped.urdf").code, 0);
    ASSERT_EQ(foam("spherize two.urdf -n 6 -m grid -o out/named.urdf").code, 0);
    EXPECT_EQ(contents(path() / "out/piped.urdf"), contents(path() / "out/named.urdf"));
    EXPECT_THAT(contents(path() / "out/piped.urdf"), AllOf(HasSubstr("filename='../meshes/box.obj'/>"),
                                                           HasSubstr("../skin.png"), HasSubstr("<!-- mine -->")));
    ASSERT_EQ(foam("spherize two.urdf -n 6 -m grid -o model.csv").code, 0);
    ASSERT_EQ(piped("two.urdf", "convert model.csv - -o out/piped.urdf").code, 0);
    ASSERT_EQ(foam("convert model.csv two.urdf -o out/named.urdf").code, 0);
    EXPECT_EQ(contents(path() / "out/piped.urdf"), contents(path() / "out/named.urdf"));
    EXPECT_EQ(piped("two.urdf", "self-collision - --samples 10").code, 0);
    EXPECT_EQ(piped("two.urdf", "self-collision - --model model.csv --samples 10").code, 0);
    EXPECT_EQ(piped("two.urdf", "view - model.csv --html page.html").code, 0);
    EXPECT_EQ(piped("two.urdf", "evaluate - model.csv").code, 0);
    const Outcome planner = piped("two.urdf", "convert model.csv - -o out/two.yml --format curobo --tool-frame tip");
    EXPECT_THAT(planner.err, HasSubstr("warning: the URDF that the file refers to is not there"));
    EXPECT_THAT(contents(path() / "out/two.yml"), HasSubstr("asset_root_path: " + path().string() + "\n"));
}

TEST_F(FromStandardInput, HullsOfAModelAreFoundFromTheCurrentFolder) {
    ASSERT_EQ(foam("approximate robot.urdf -n 1 --with hull -o hulls.urdf").code, 0);
    EXPECT_EQ(piped("hulls.urdf", "certify robot.urdf -").code, 0);
    EXPECT_EQ(piped("hulls.urdf", "convert - -o hulls.json").code, 0);
    EXPECT_EQ(foam("certify robot.urdf hulls.json").code, 0);
}

TEST_F(FromStandardInput, AModelIsRecognisedByItsReader) {
    ASSERT_EQ(foam("spherize box.obj -n 3 -m grid -o spheres.csv").code, 0);
    EXPECT_EQ(piped("spheres.csv", "certify box.obj -").code, 0);
    const Outcome converted = piped("spheres.csv", "convert - -o spheres.json");
    EXPECT_EQ(converted.code, 0) << converted.err;
    EXPECT_EQ(foam("certify box.obj spheres.json").code, 0);
    EXPECT_EQ(piped("spheres.csv", "compare box.obj - --html page.html").code, 0);
    EXPECT_THAT(contents(path() / "page.html"), Not(HasSubstr("/foam-")));
    const auto judged = nlohmann::json::parse(piped("spheres.csv", "certify box.obj - --json").out);
    EXPECT_EQ(judged.at("model"), "stdin");
}

TEST_F(FromStandardInput, ARecipeLeadsFromTheCurrentFolder) {
    write("box.yaml",
          "foam: 1\nmesh: box.obj\nstages:\n  - spherize.grid\nbudget: {spheres: 2}\noutputs:\n  - write.csv\n");
    EXPECT_EQ(piped("box.yaml", "check -").err, "foam: stdin: valid, 1 run\n");
    EXPECT_EQ(piped("box.yaml", "plan -").code, 0);
    EXPECT_EQ(piped("box.yaml", "run -").code, 0);
    EXPECT_TRUE(fs::exists(path() / "runs/stdin/manifest.json"));
    write("wrong.yaml", "foam: 1\nmesh: box.obj\nstages: [spherize.octre]\nbudget: {spheres: 2}\n");
    const Outcome wrong = piped("wrong.yaml", "check -");
    EXPECT_EQ(wrong.code, 2);
    EXPECT_THAT(wrong.out, HasSubstr("stdin:3:10: error[unknown-stage]"));
}

TEST_F(FromStandardInput, WhatNeedsANameSaysSo) {
    for (const auto& [arguments, message] : std::vector<std::pair<std::string, std::string>>{
             {"spherize - -n 3", "the input - gives the output no name; remedy: -o FILE, or -o - with --format"},
             {"spherize - -n 3 -o a.csv --run-dir r",
              "a run directory names its input, so that the run can be repeated, and - has no name; remedy: a file "
              "instead of -, or without --run-dir"},
             {"spherize - -n 3 --print-recipe",
              "a recipe names its input, and - has no name; remedy: a file instead of -"},
             {"spherize - -n 3 -o a.urdf", "write.urdf writes the name of the mesh, and - has no name; remedy: another "
                                           "format, or a file instead of -"},
             {"certify - -", "the standard input can be read once; remedy: one -, and files"},
         }) {
        const Outcome outcome = piped("box.obj", arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_EQ(outcome.err, "foam: error: " + message + "\n");
    }
    EXPECT_EQ(foam("info box.obj --input-format stl").err,
              "foam: error: --input-format is for the input -; remedy: without it\n");
}

TEST_F(FromStandardInput, ErrorsNameTheStandardInput) {
    EXPECT_EQ(piped("/dev/null", "info -").err,
              "foam: error: stdin: it is empty; remedy: pipe the input into foam, or name a file\n");
    EXPECT_EQ(shell("echo hello | '" FOAM_TEST_BINARY "' info -").err,
              "foam: error: stdin: no format of robots or meshes is recognised in it; remedy: --input-format, such as "
              "--input-format stl\n");
    const Outcome broken = shell("echo 'v 1 2' | '" FOAM_TEST_BINARY "' info - 2>&1");
    EXPECT_NE(broken.code, 0);
    EXPECT_THAT(broken.out, HasSubstr("stdin:1"));
    EXPECT_THAT(broken.out, Not(HasSubstr("/foam-")));
    EXPECT_EQ(shell("printf '<robot name=\"r\">\\n<link/></robot>' | '" FOAM_TEST_BINARY "' info -").err,
              "foam: error: stage 'load.urdf': stdin:2: <link> has no name\n");
    const Outcome missing = shell("sed s/box.obj/none.obj/ robot.urdf | '" FOAM_TEST_BINARY "' info -");
    EXPECT_THAT(missing.err, HasSubstr((path() / "meshes/none.obj").string()));
}

constexpr const char* too_long =
    "foam: error: stdin: more than 1073741824 bytes; remedy: check that this is the input you mean\n";

/// A file of 4 GB that takes no room, where no file may have more than a megabyte.
TEST_F(FromStandardInput, ATooLongFileIsRefusedUnread) {
    write("long.stl", "");
    fs::resize_file(path() / "long.stl", std::uintmax_t{4} << 30);
    for (const char* arguments : {"info -", "certify box.obj -", "view - --html a.html"}) {
        const Outcome outcome =
            shell("ulimit -f 1000 && '" FOAM_TEST_BINARY "' " + std::string(arguments) + " < long.stl");
        EXPECT_EQ(outcome.code, 1) << arguments;
        EXPECT_EQ(outcome.err, too_long) << arguments;
    }
}

TEST_F(FromStandardInput, AnEndlessPipeIsRefused) {
    if (std::string(FOAM_ABI_SANITIZER) != "none") {
        GTEST_SKIP() << "sanitizers take address space as they like";
    }
    if (fs::space(path()).available < std::uintmax_t{3} << 30) {
        GTEST_SKIP() << "there is no room for a file of a gigabyte";
    }
    fs::create_directory(path() / "tmp");
    const Outcome endless =
        shell("export TMPDIR='@/tmp'; ulimit -v 1000000; cat /dev/zero | '" FOAM_TEST_BINARY "' info -");
    EXPECT_EQ(endless.code, 1);
    EXPECT_EQ(endless.err, too_long);
    EXPECT_TRUE(fs::is_empty(path() / "tmp"));
}

TEST_F(FromStandardInput, AnEndlessRecipeIsRefused) {
    const Outcome endless = shell("yes | '" FOAM_TEST_BINARY "' check -");
    EXPECT_EQ(endless.code, 1);
    EXPECT_EQ(endless.err,
              "foam: error: stdin: more than 1000000 bytes; remedy: check that this is the input you mean\n");
}

TEST_F(FromStandardInput, FormatIsGivenWhereContentDoesNotShowIt) {
    write("odd.obj", "p 1\n" + std::string(box_obj));
    EXPECT_NE(piped("odd.obj", "info -").code, 0);
    EXPECT_EQ(piped("odd.obj", "info - --input-format obj").code, 0);
}

} // namespace
} // namespace foam::test
