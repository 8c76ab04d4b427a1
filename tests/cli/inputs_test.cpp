// What foam takes for the input: its size, its unit, files that are no ordinary ones.
#include "program.hpp"

#include <foam/sdk/abi.hpp>

#include <nlohmann/json.hpp>

#include <regex>
#include <sys/stat.h>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// An open tray of 120 x 80 x 40, in whatever unit.
constexpr const char* tray_obj = "v 0 0 0\nv 120 0 0\nv 120 80 0\nv 0 80 0\nv 0 0 40\nv 120 0 40\n"
                                 "f 1 3 2\nf 1 4 3\nf 1 2 6\nf 1 6 5\n";

class CliInputs : public Cli {
protected:
    void SetUp() override {
        write("box.obj", box_obj);
        write("tray.obj", tray_obj);
        write("arm.urdf",
              "<robot name=\"arm\">\n"
              "  <link name=\"base\"><collision><geometry><box size=\"0.2 0.1 0.3\"/></geometry></collision></link>\n"
              "  <link name=\"tip\"><collision><origin xyz=\"0 0 0.5\"/><geometry><cylinder radius=\"0.05\" "
              "length=\"1\"/></geometry></collision></link>\n"
              "  <joint name=\"j\" type=\"fixed\"><origin xyz=\"0 0 0.15\" rpy=\"0 1.5707963267948966 0\"/><parent "
              "link=\"base\"/><child link=\"tip\"/></joint>\n"
              "</robot>\n");
    }

    Outcome spherize(const std::string& arguments) const {
        return foam("spherize " + arguments + " -n 2 -m grid -o out.json");
    }
};

TEST_F(CliInputs, TheFirstLineTellsTheSize) {
    EXPECT_THAT(spherize("box.obj").err, StartsWith("foam: box.obj: 200 x 100 x 300 mm, 12 triangles\n"));
    EXPECT_THAT(spherize("arm.urdf").err,
                StartsWith("foam: arm.urdf: 2 links, 1.1 x 0.1 x 0.35 m in the reference pose\n"));
    write("box.yaml", "foam: 1\nmesh: box.obj\nstages: [spherize.grid]\nbudget: {spheres: 2}\n");
    EXPECT_THAT(foam("run box.yaml").err, HasSubstr(")\nfoam: box.obj: 200 x 100 x 300 mm, 12 triangles\n"));
    const json result = json::parse(foam("run box.yaml --json").out).at("runs").at(0).at("input_size");
    EXPECT_EQ(result, json({{"size_m", {0.2, 0.1, 0.3}}, {"links", 1}, {"triangles", 12}}));
}

TEST_F(CliInputs, AMeshHasAUnitAndAScale) {
    ASSERT_THAT(spherize("tray.obj --unit mm").err, StartsWith("foam: tray.obj: 120 x 80 x 40 mm, 4 triangles\n"));
    EXPECT_EQ(foam("certify tray.obj out.json --unit mm").code, 0);
    EXPECT_EQ(foam("certify tray.obj out.json").code, 1) << "120 m are not in these spheres";
    EXPECT_EQ(foam("certify tray.obj out.json --unit cm --scale 0.1").code, 0);
    const json judged = json::parse(foam("evaluate tray.obj out.json --scale 0.001 --json").out);
    EXPECT_EQ(judged.at("total").at("covered"), 1);
    EXPECT_EQ(foam("compare tray.obj out.json out.json --unit mm").code, 0);
    EXPECT_THAT(spherize("tray.obj --unit in --scale 2").err, StartsWith("foam: tray.obj: 6.1 x 4.06 x 2.03 m, "));
}

TEST_F(CliInputs, ARecipeSaysTheUnit) {
    write("tray.yaml", "foam: 1\nmesh: tray.obj\nunit: mm\nscale: 2\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
                       "outputs: [write.json, write.urdf]\n");
    const Outcome run = foam("run tray.yaml");
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.err, HasSubstr("foam: tray.obj: 240 x 160 x 80 mm, 4 triangles\n"));
    EXPECT_THAT(contents(path() / "runs/tray/recipe.resolved.yaml"), HasSubstr("\nunit: mm\nscale: 2\n"));
    EXPECT_EQ(foam("verify runs/tray").code, 0);
    EXPECT_THAT(contents(path() / "runs/tray/tray.urdf"),
                HasSubstr("<mesh filename=\"../../tray.obj\" scale=\"0.002 0.002 0.002\"/>"));
    EXPECT_THAT(foam("spherize tray.obj --unit mm --scale 2 -m grid --print-recipe").out,
                HasSubstr("\nunit: mm\nscale: 2\n"));
}

TEST_F(CliInputs, WhatHasItsUnitTakesNone) {
    const std::string robot =
        "is no mesh: a robot is in metres, and the scale of a mesh of it stands in the URDF, <mesh "
        "scale=\"0.001 0.001 0.001\"/>; remedy: give no unit and no scale\n";
    for (const std::string option : {"--unit mm", "--scale 2"}) {
        const Outcome outcome = spherize("arm.urdf " + option);
        EXPECT_EQ(outcome.code, 2) << option;
        EXPECT_EQ(outcome.err, "foam: error: arm.urdf " + robot);
    }
    write("arm.yaml", "foam: 1\nrobot: {urdf: arm.urdf}\nunit: mm\nstages: [spherize.grid]\n");
    EXPECT_THAT(foam("check arm.yaml").err + foam("check arm.yaml").out,
                HasSubstr("arm.yaml:3:1: error[conflict]: arm.urdf " + robot));
    EXPECT_EQ(foam("certify arm.urdf arm.urdf --unit mm").code, 2);
    write("part.GLB", "");
    const Outcome own = spherize("part.GLB --unit mm");
    EXPECT_EQ(own.code, 2);
    EXPECT_THAT(own.err, HasSubstr("part.GLB says its unit itself, as every glb does; remedy: give no unit, or a scale "
                                   "if that is wrong"));
    EXPECT_THAT(spherize("part.GLB --scale 2").err, HasSubstr("the file is empty")) << "a scale is allowed";
    EXPECT_THAT(spherize("tray.obj --unit km").err, HasSubstr("km"));
    EXPECT_EQ(spherize("tray.obj --unit km").code, 2);
    EXPECT_EQ(spherize("tray.obj --scale 0").code, 2);
}

TEST_F(CliInputs, AnUnlikelySizeIsAWarning) {
    EXPECT_THAT(spherize("tray.obj").err,
                HasSubstr("foam: warning: tray.obj: 120 x 80 x 40 m is large for an object; if it is in millimetres: "
                          "--unit mm, or 'unit: mm' in the recipe\n"));
    EXPECT_THAT(spherize("tray.obj --scale 1e-6").err,
                HasSubstr("0.12 x 0.08 x 0.04 mm is small for an object; if that "
                          "is wrong: --scale 0.001, or 'scale: 0.001'"));
    EXPECT_THAT(spherize("tray.obj --unit mm").err, Not(HasSubstr("for an object")));
    EXPECT_THAT(spherize("arm.urdf").err, Not(HasSubstr("for an object")));
}

TEST_F(CliInputs, LengthsTakeUnits) {
    EXPECT_THAT(foam("spherize box.obj --max-protrusion 10mm --print-recipe").out,
                HasSubstr("budget: {max_protrusion: 0.01m} "));
    const Outcome wrong = foam("spherize box.obj --max-protrusion 10km");
    EXPECT_EQ(wrong.code, 2);
    EXPECT_EQ(wrong.err, "foam: error: --max-protrusion expects a number in m, or one with mm, cm, m or in behind it, "
                         "such as 10mm; got '10km'\n");
    EXPECT_THAT(spherize("box.obj --max-protrusion 10").err,
                HasSubstr("foam: warning: max_protrusion is 10 m, larger than the whole input (300 mm): it has no "
                          "effect; if it is in millimetres: 10mm\n"));
    EXPECT_THAT(spherize("box.obj --max-protrusion 10mm").err, Not(HasSubstr("it limits nothing")));
    ASSERT_EQ(spherize("box.obj").code, 0);
    EXPECT_THAT(foam("evaluate box.obj out.json --clip box=0,0,-1,5cm").out, HasSubstr("mm beyond the plane"));
    EXPECT_EQ(foam("evaluate box.obj out.json --clip box=0,0,-1,5cm").out,
              foam("evaluate box.obj out.json --clip box=0,0,-1,0.05").out);
    EXPECT_EQ(foam("evaluate box.obj out.json --clip box=0,0,-1mm,5").code, 2);
}

class CliReferences : public Cli {
protected:
    void SetUp() override {
        fs::create_directories(path() / "in/meshes");
        write("in/meshes/box.obj", box_obj);
        write("in/robot.urdf", urdf("meshes/box.obj"));
        write("in/recipe.yaml",
              "foam: 1\nname: robot\nrobot: {urdf: robot.urdf}\nstages: [spherize.grid]\nbudget: {spheres: 2}\n"
              "outputs: [write.urdf: {file: sub/robot.urdf}]\n");
    }

    static std::string urdf(const std::string& mesh) {
        return "<robot name=\"r\"><link name=\"a\"><visual><geometry><mesh filename=\"" + mesh +
               "\"/></geometry></visual><collision><geometry><mesh filename=\"meshes/box.obj\"/></geometry></collision>"
               "</link></robot>";
    }

    /// The mesh that a written file names, "" if it is not there.
    std::string visual_of(const fs::path& file) const {
        std::smatch found;
        const std::string text = contents(path() / file);
        if (!std::regex_search(text, found, std::regex("<mesh filename=\"([^\"]*)\""))) {
            return "";
        }
        return fs::exists((path() / file).parent_path() / found[1].str()) ? found[1].str() : "";
    }
};

TEST_F(CliReferences, LeadFromWhereTheFileLies) {
    fs::create_directory(path() / "out");
    ASSERT_EQ(foam("spherize in/robot.urdf -n 2 -m grid -o out/robot.urdf").code, 0);
    EXPECT_EQ(visual_of("out/robot.urdf"), "../in/meshes/box.obj");
    ASSERT_EQ(foam("spherize in/robot.urdf -n 2 -m grid -o in/spheres.urdf --run-dir kept").code, 0);
    EXPECT_EQ(visual_of("in/spheres.urdf"), "meshes/box.obj");
    EXPECT_EQ(visual_of("kept/robot_spheres.urdf"), "../in/meshes/box.obj") << "the run directory's own file";
    const Outcome again = foam("spherize out/robot.urdf -n 2 -m grid -o again.urdf -v");
    EXPECT_THAT(again.err, Not(HasSubstr("not found")));
}

/// A run directory is filled under another name.
TEST_F(CliReferences, LeadFromTheRunDirectory) {
    ASSERT_EQ(foam("run in/recipe.yaml").code, 0);
    EXPECT_EQ(visual_of("runs/robot/sub/robot.urdf"), "../../../in/meshes/box.obj");
    EXPECT_EQ(foam("verify runs/robot").code, 0) << "where it is made again does not matter";
    const Outcome locked = foam("run --locked runs/robot/manifest.json in/recipe.yaml --run-dir deep/er/run");
    EXPECT_EQ(locked.code, 0) << locked.err;
    EXPECT_EQ(visual_of("deep/er/run/sub/robot.urdf"), "../../../../in/meshes/box.obj");
    ASSERT_EQ(foam("run in/recipe.yaml --run-dir absolute --set outputs.write.urdf.mesh_paths=absolute").code, 0);
    EXPECT_THAT(contents(path() / "absolute/sub/robot.urdf"),
                HasSubstr("<mesh filename=\"" + (fs::canonical(path()) / "in/meshes/box.obj").string() + "\""));
    ASSERT_EQ(foam("run in/recipe.yaml --run-dir keep --set outputs.write.urdf.mesh_paths=keep").code, 0);
    EXPECT_THAT(contents(path() / "keep/sub/robot.urdf"), HasSubstr("<mesh filename=\"meshes/box.obj\""));
}

TEST_F(CliReferences, ThatCannotLeadAreTold) {
    const Outcome piped = foam("spherize in/robot.urdf -n 2 -m grid -o - --format urdf");
    EXPECT_THAT(piped.out, HasSubstr("<mesh filename=\"meshes/box.obj\""));
    EXPECT_THAT(piped.err, HasSubstr("warning: relative paths of meshes are kept as they are (the first: "));
    write("in/robot.urdf", urdf("meshes/none.obj"));
    const Outcome lost = foam("spherize in/robot.urdf -n 2 -m grid -o robot.urdf");
    EXPECT_THAT(lost.err, HasSubstr("1 relative paths of meshes lead to no file from the folder of "));
    EXPECT_THAT(contents(path() / "robot.urdf"), HasSubstr("<mesh filename=\"meshes/none.obj\""));
}

TEST_F(CliReferences, OfThePanda) {
    fs::create_directory(path() / "out");
    ASSERT_EQ(foam("spherize '" FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf' -n 12 -m grid -o out/p.urdf").code,
              0);
    const std::string text = contents(path() / "out/p.urdf");
    const std::regex reference("filename=\"([^\"]*)\"");
    std::size_t count = 0;
    for (std::sregex_iterator it(text.begin(), text.end(), reference), end; it != end; ++it, ++count) {
        EXPECT_TRUE(fs::exists(path() / "out" / (*it)[1].str())) << (*it)[1];
    }
    EXPECT_GE(count, 8U);
}

/// Files of 4 GB that take no room, in 2 GB of memory.
TEST_F(CliInputs, SparseFilesAreRefusedUnread) {
    if (std::string(FOAM_ABI_SANITIZER) != "none") {
        GTEST_SKIP() << "sanitizers take address space as they like";
    }
    const auto refused = [&](const std::string& command, const std::string& file) {
        if (!fs::exists(path() / file)) {
            write(file, "");
        }
        fs::resize_file(path() / file, std::uintmax_t{4} << 30);
        const Outcome outcome = shell("ulimit -v 2000000 && '" FOAM_TEST_BINARY "' " + command);
        EXPECT_NE(outcome.code, 0);
        EXPECT_THAT(outcome.err + outcome.out, HasSubstr("it has 4294967296 bytes, more than ")) << command;
    };
    for (const std::string file : {"part.stl", "part.obj", "part.ply", "part.dae", "part.glb"}) {
        refused("spherize " + file + " -n 2", file);
        refused("certify " + file + " arm.urdf", file);
    }
    refused("spherize big.urdf -n 2", "big.urdf");
    refused("certify arm.urdf big.json", "big.json");
    refused("run big.yaml", "big.yaml");
    refused("self-collision big.urdf", "big.urdf");
    write("uri.urdf", "<robot name=\"u\"><link name=\"a\"><collision><geometry><mesh filename=\"file://" +
                          (path() / "part.stl").string() + "\"/></geometry></collision></link></robot>");
    refused("spherize uri.urdf -n 2", "part.stl");
}

TEST_F(CliInputs, AFlatMeshFarAwayGetsElementsOfEveryKind) {
    write("sheet.obj", "v 9999.5 9999.5 10000\nv 10000.5 9999.5 10000\nv 10000.5 10000.5 10000\nv 9999.5 10000.5 10000\n"
                       "f 1 2 3\nf 1 3 4\n");
    for (const char* kind : {"hull", "box", "capsule", "cylinder", "swept_box"}) {
        const Outcome made = foam("approximate sheet.obj -n 1 -o sheet.json --force --effort fast --with " + std::string(kind));
        EXPECT_EQ(made.code, 0) << kind << made.err;
        EXPECT_EQ(foam("certify sheet.obj sheet.json").code, 0) << kind;
    }
}

TEST_F(CliInputs, PipesAndDevicesAreRefusedUnread) {
    for (const char* name : {"pipe.stl", "pipe.urdf", "pipe.json", "pipe.yaml"}) {
        ASSERT_EQ(mkfifo((path() / name).c_str(), 0600), 0);
    }
    const auto refused = [&](const std::string& command) {
        const Outcome outcome = shell("timeout 60 '" FOAM_TEST_BINARY "' " + command);
        EXPECT_NE(outcome.code, 0) << command;
        EXPECT_NE(outcome.code, 124) << command << ": it hung";
        EXPECT_THAT(outcome.err + outcome.out, ::testing::ContainsRegex("regular file")) << command;
    };
    refused("spherize pipe.stl");
    refused("spherize pipe.urdf");
    refused("certify arm.urdf pipe.json");
    refused("certify arm.urdf /dev/zero");
    refused("run pipe.yaml");
    refused("check pipe.yaml");
    refused("self-collision pipe.urdf");
    fs::create_symlink("/dev/zero", path() / "zero.urdf");
    refused("certify zero.urdf arm.urdf");
}

} // namespace
} // namespace foam::test
