// Robots as the field writes them, from the command line to the written file.
#include "program.hpp"

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class RobotsIn : public Cli {
protected:
    void SetUp() override {
        fs::copy(fs::path(FOAM_TEST_SOURCE) / "tests/cli/robots_in", path(), fs::copy_options::recursive);
        fs::copy(fs::path(FOAM_TEST_SOURCE) / "tests/load_urdf/tolerance", path() / "tolerance",
                 fs::copy_options::recursive);
        fs::create_directories(path() / "bin");
        write("bin/xacro", "#!/bin/sh\n[ \"$2\" = broken:=1 ] && { echo 'name is not defined' >&2; exit 2; }\n"
                           "echo \"<robot name='r'><link name='a'><collision><geometry><box size='0.1 0.1 "
                           "${2#len:=}'/></geometry></collision></link></robot>\"\n");
        fs::permissions(path() / "bin/xacro", fs::perms::owner_all);
    }
    /// Runs foam with the program xacro of this test.
    Outcome with_xacro(const std::string& arguments) const {
        return shell("PATH='@/bin':$PATH '" FOAM_TEST_BINARY "' " + arguments);
    }
};

TEST_F(RobotsIn, WrongFilesKeepTheirBytesOutsideCollisions) {
    for (const fs::directory_entry& entry : fs::directory_iterator(path() / "tolerance")) {
        if (entry.path().extension() != ".urdf") {
            continue;
        }
        const Outcome outcome =
            foam("spherize '" + entry.path().string() + "' -n 6 -m octree -o '@/tolerance/out.urdf'");
        ASSERT_EQ(outcome.code, 0) << entry.path() << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("foam: warning: load.urdf: ")) << entry.path();
        const std::string before = contents(entry.path()), after = contents(path() / "tolerance/out.urdf");
        const std::size_t begin = before.find("<collision>"), end = before.rfind("</collision>");
        EXPECT_EQ(after.substr(0, begin), before.substr(0, begin)) << entry.path();
        EXPECT_TRUE(after.ends_with(before.substr(end + 12))) << entry.path();
        EXPECT_EQ(before.find("<plane") != before.npos, after.find("<plane") != after.npos);
        fs::remove(path() / "tolerance/out.urdf");
    }
}

TEST_F(RobotsIn, VisualGeometryInPlaceOfNone) {
    const Outcome none = foam("spherize visual_only/none.urdf -n 4 -o out.urdf");
    EXPECT_EQ(none.code, 1);
    EXPECT_THAT(none.err, HasSubstr("no link has collision geometry: there is nothing to turn into spheres; remedy: "
                                    "--geometry visual, or cover: visual in the recipe"));
    const Outcome mix = foam("spherize visual_only/mix.urdf -n 8 -m octree -o out.urdf");
    EXPECT_EQ(mix.code, 0) << mix.err;
    EXPECT_THAT(mix.err, HasSubstr("warning: the visual geometry extends beyond the collision geometry, which is what "
                                   "elements cover: base (5 mm); to cover both: --geometry both, or cover: both in the "
                                   "recipe"));
    const Outcome both =
        foam("spherize visual_only/mix.urdf -n 8 -m octree -o out.urdf --geometry collision-or-visual");
    EXPECT_EQ(both.code, 0) << both.err;
    const std::string written = contents(path() / "out.urdf");
    EXPECT_NE(written.find("<collision>", written.find("name=\"arm\"")), written.npos) << written;
}

TEST_F(RobotsIn, UnitsAreQuestioned) {
    EXPECT_THAT(foam("spherize robot_units/bracket_unscaled.urdf -n 4 -m octree -o out.urdf").err,
                HasSubstr("is large for a robot; if the mesh of link 'bracket' is in millimetres: <mesh scale=\"0.001 "
                          "0.001 0.001\"/>"));
    ASSERT_EQ(foam("spherize visual_only/mix.urdf -n 8 -m octree -o out.urdf").code, 0);
    EXPECT_THAT(foam("convert out.urdf --pad 5 -o out.csv").err,
                HasSubstr("warning: --pad is 5 m, larger than the largest link"));
    EXPECT_THAT(foam("convert out.urdf --pad 5mm -o out.csv").err, Not(HasSubstr("warning: --pad")));
}

TEST_F(RobotsIn, PackagesByName) {
    fs::create_directories(path() / "here");
    write("here/box.obj", box_obj);
    write("arm.urdf", "<robot name='r'><link name='a'><collision><geometry><mesh filename='package://arm/box.obj'/>"
                      "</geometry></collision></link></robot>");
    const Outcome missing = foam("spherize arm.urdf -n 4 -o out.urdf");
    EXPECT_EQ(missing.code, 1);
    EXPECT_THAT(missing.err, HasSubstr("arm.urdf:1: mesh 'package://arm/box.obj' of link 'a' is not found; tried:\n"));
    EXPECT_THAT(missing.err, HasSubstr("remedy: --package arm=FOLDER"));
    EXPECT_EQ(foam("spherize arm.urdf -n 4 -m octree -o out.urdf --package arm=here").code, 0);
    EXPECT_EQ(foam("evaluate arm.urdf out.urdf --package arm=here").code, 0);
    const Outcome unused = foam("spherize arm.urdf -n 4 -o out.urdf --package arms=here");
    EXPECT_EQ(unused.code, 2);
    EXPECT_THAT(unused.err, HasSubstr("is in a package 'arms'; did you mean 'arm'?"));
    EXPECT_EQ(foam("spherize arm.urdf -n 4 -o out.urdf --package here").code, 2);
    EXPECT_EQ(foam("spherize arm.urdf -n 4 -o out.urdf --package arm=nowhere").code, 1);
}

TEST_F(RobotsIn, AMissingMeshStopsItsLinkAlone) {
    write("arm.urdf", "<robot name='r'><link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision>"
                      "</link><link name='b'><collision><geometry><mesh filename='none.stl'/></geometry></collision>"
                      "</link><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
    EXPECT_EQ(foam("spherize arm.urdf -n 4 -m octree -o out.urdf --set links.b.skip=true").code, 0);
    const Outcome needed = foam("spherize arm.urdf -n 4 -m octree -o out.urdf");
    EXPECT_EQ(needed.code, 1);
    EXPECT_THAT(needed.err, HasSubstr("mesh 'none.stl' of link 'b' is not found"));
}

TEST_F(RobotsIn, NamesOfFilesThatAreNearlyRight) {
    write("robot.urdf", "<robot/>");
    EXPECT_THAT(foam("spherize robto.urdf -n 4").err,
                HasSubstr("there is no such file; remedy: check the path; did you mean 'robot.urdf'?"));
}

TEST_F(RobotsIn, Xacro) {
    const std::string file = "xacro/arm.urdf.xacro";
    const Outcome outcome = with_xacro("spherize " + file + " len:=0.4 -n 4 -m octree");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(contents(path() / "arm_spheres.urdf"), HasSubstr("<link name='a'><collision>"));
    write("arm.yaml", "foam: 1\nrobot: {xacro: xacro/arm.urdf.xacro, args: {len: 0.4}}\nstages: [spherize.octree]\n"
                      "budget: {spheres: 4}\noutputs:\n  - write.xacro: {file: arm.xacro}\n");
    const Outcome run = with_xacro("run arm.yaml --run-dir out");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(contents(path() / "out/arm.xacro"), HasSubstr("  <xacro:macro name=\"a_collision\">\n    <collision>"));
    const Outcome fails = with_xacro("spherize " + file + " broken:=1 -n 4");
    EXPECT_EQ(fails.code, 1);
    EXPECT_THAT(fails.err, HasSubstr("arm.urdf.xacro: xacro fails:\n  name is not defined"));
    const Outcome none = shell("PATH=/none '" FOAM_TEST_BINARY "' spherize " + file + " -n 4");
    EXPECT_EQ(none.code, 3);
    EXPECT_THAT(none.err, HasSubstr("the program xacro cannot be started (No such file or directory); remedy: pip "
                                    "install xacro"));
    EXPECT_EQ(foam("spherize visual_only/mix.urdf len:=1 -n 4").code, 2);
    write("other.yaml", "foam: 1\nrobot: {xacro: visual_only/mix.urdf}\nstages: [spherize.octree]\n");
    EXPECT_THAT(foam("check other.yaml").out + foam("check other.yaml").err, HasSubstr("does not end in .xacro"));
}

TEST_F(RobotsIn, TheOutputOfAnMjcfIsTheSameFile) {
    const std::string before = R"(<mujoco model="arm">
  <!-- mine -->
  <default><geom friction="0.3"/></default>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="base"><joint name="turn"/><geom type="box" size="0.1 0.1 0.2"/></body>
  </worldbody>
  <actuator><motor joint="turn"/></actuator>
</mujoco>
)";
    write("arm.xml", before);
    for (const char* command : {"approximate arm.xml -n 2 --with capsule", "spherize arm.xml -n 8 -m octree",
                                "spherize arm.xml -n 8 -m octree -o arm_spheres.xml --force"}) {
        const Outcome outcome = foam(command);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("Proved: ")) << command;
        const std::string after =
            contents(path() / (std::string(command).starts_with("a") ? "arm_elements.xml" : "arm_spheres.xml"));
        const std::size_t begin = before.find("<geom type=\"box\""), end = before.find("</body>");
        EXPECT_EQ(after.substr(0, begin), before.substr(0, begin)) << command;
        EXPECT_TRUE(after.ends_with(before.substr(end))) << command;
        EXPECT_THAT(after, HasSubstr(R"(<geom contype="0" conaffinity="0" type="box" size="0.1 0.1 0.2"/>)")) << command;
    }
    write("arm.urdf", R"(<robot name="r"><link name="a"><collision><geometry><box size="1 1 1"/></geometry></collision>)"
                      R"(</link></robot>)");
    EXPECT_EQ(foam("spherize arm.urdf -n 8 -m octree -o other.xml").code, 0);
    EXPECT_THAT(contents(path() / "other.xml"), HasSubstr("<mujoco"));
}

/// A file that the input includes is an input: it is not replaced, and a run tells when it has changed.
TEST_F(RobotsIn, IncludedFilesAreInputs) {
    const std::string part = "<mujoco><worldbody><body name='base'><geom size='0.1'/></body></worldbody></mujoco>\n";
    write("part.xml", part);
    write("arm.xml", "<mujoco><include file='part.xml'/></mujoco>\n");
    const Outcome over = foam("spherize arm.xml -n 1 -m octree -o part.xml");
    EXPECT_EQ(over.code, 2);
    EXPECT_THAT(over.err, HasSubstr("part.xml: the output would replace the input "));
    EXPECT_EQ(contents(path() / "part.xml"), part);
    write("arm.yaml", "foam: 1\nrobot: {urdf: arm.xml}\nstages: [spherize.octree]\nbudget: {spheres: 1}\n");
    ASSERT_EQ(foam("run arm.yaml --run-dir out").code, 0);
    EXPECT_THAT(contents(path() / "out/manifest.json"), HasSubstr("\"further_files\": [\n    {\n      \"file\": \"part.xml\""));
    EXPECT_EQ(foam("verify out").code, 0);
    write("part.xml", part + "<!-- later -->");
    const Outcome verified = foam("verify out");
    EXPECT_EQ(verified.code, 1);
    EXPECT_THAT(verified.out, HasSubstr("further file"));
    EXPECT_THAT(verified.out, HasSubstr("part.xml"));
}

#if FOAM_TEST_SDF
TEST_F(RobotsIn, TheOutputOfAnSdfIsTheSameFile) {
    const std::string surface = "<surface><friction><ode><mu>0.5</mu></ode></friction></surface>";
    const std::string before = R"(<sdf version="1.6">
  <!-- mine -->
  <model name="arm">
    <link name="base">
      <collision name="floor"><geometry><plane/></geometry></collision>
      <collision name="foot"><pose>0 0 0.1 0 0 0</pose><geometry><box><size>0.2 0.2 0.2</size></box></geometry>)" +
                               surface + R"(</collision>
      <visual name="seen"><geometry><mesh><uri>box.obj</uri></mesh></geometry></visual>
    </link>
  </model>
</sdf>
)";
    write("box.obj", box_obj);
    write("model.sdf", before);
    for (const auto& [command, file] : {std::pair("spherize model.sdf -n 8 -m octree", "model_spheres.sdf"),
                                        std::pair("approximate model.sdf --with capsule -n 2", "model_elements.sdf"),
                                        std::pair("approximate model.sdf --with capsule -n 2 -o model_capsules.sdf",
                                                  "model_capsules.sdf")}) {
        const Outcome outcome = foam(command);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.out, HasSubstr("Proved: ")) << command;
        const std::string after = contents(path() / file);
        const std::size_t begin = before.find("<collision name=\"foot\""), end = before.find("      <visual");
        EXPECT_EQ(after.substr(0, begin), before.substr(0, begin)) << command;
        EXPECT_TRUE(after.ends_with(before.substr(end))) << command << after;
        EXPECT_THAT(after, HasSubstr("</geometry>" + surface + "</collision>")) << command;
        EXPECT_EQ(foam(std::string("certify model.sdf ") + file).code, 0) << command;
    }
    EXPECT_EQ(foam("gallery model.sdf 4 -o model.png").code, 0) << "the first file is the robot";
    fs::create_directories(path() / "other");
    ASSERT_EQ(foam("spherize model.sdf -n 8 -m octree -o other/moved.sdf").code, 0);
    EXPECT_THAT(contents(path() / "other/moved.sdf"), HasSubstr("<uri>../box.obj</uri>"));
    EXPECT_EQ(foam("spherize model.sdf -n 8 -m octree -o model.urdf").code, 0);
    write("world.sdf", "<sdf version='1.9'><world name='w'>\n<include><uri>model.sdf</uri></include></world></sdf>");
    const Outcome included = foam("spherize world.sdf -n 8 -m octree");
    EXPECT_EQ(included.code, 1);
    EXPECT_THAT(included.err, HasSubstr("world.sdf:2: link 'base' is not in this file, but in one that it includes; "
                                        "remedy: the included file as the input"));
}
#else
TEST_F(RobotsIn, AnSdfNeedsLibsdformat) {
    write("model.sdf", "<sdf version='1.9'><model name='m'><link name='l'/></model></sdf>");
    const Outcome outcome = foam("spherize model.sdf -n 8");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("model.sdf: this is SDF, and foam was built without libsdformat 12"));
}
#endif

TEST_F(RobotsIn, UsdNeedsAPythonThatReadsIt) {
    write("bin/python", "#!/bin/sh\necho \"No module named 'pxr'\" >&2; exit 3\n");
    fs::permissions(path() / "bin/python", fs::perms::owner_all);
    const Outcome none = shell("FOAM_PYTHON='@/bin/python' '" FOAM_TEST_BINARY "' info robot.usda");
    EXPECT_EQ(none.code, 3);
    EXPECT_THAT(none.err, HasSubstr("this is USD, which the Python package usd-core reads, and '"));
    EXPECT_THAT(none.err, HasSubstr("' has none:\n  No module named 'pxr'\nremedy: pip install usd-core"));
    const Outcome no_python = shell("FOAM_PYTHON=/none/python '" FOAM_TEST_BINARY "' info robot.usda");
    EXPECT_EQ(no_python.code, 3);
    EXPECT_THAT(no_python.err, HasSubstr("'/none/python' cannot be started (No such file or directory); remedy: pip"));
}

TEST_F(RobotsIn, Utf16ComesBackAsUtf8) {
    const std::string start = "<?xml version='1.0' encoding='",
                      middle = "'?>\n<robot name='r'>\n<!-- kept -->\n<link name='a'>", end = "</link>\n</robot>\n";
    const std::string collision = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
    for (const std::string& mark : {std::string("\xFF\xFE"), std::string()}) {
        std::string wide = mark;
        for (const char c : start + "UTF-16" + middle + collision + end) {
            wide += c;
            wide += '\0';
        }
        write("wide.urdf", wide);
        const Outcome outcome = foam("spherize wide.urdf -n 6 -m octree -o wide.urdf --force");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.err,
                    HasSubstr("the text is UTF-16, which ROS cannot read; what foam writes of it is UTF-8"));
        const std::string after = contents(path() / "wide.urdf");
        EXPECT_TRUE(after.starts_with(start + "UTF-8" + middle + "<collision>")) << after;
        EXPECT_TRUE(after.ends_with("</collision>" + end)) << after;
        EXPECT_EQ(foam("evaluate wide.urdf wide.urdf").code, 0);
        write("wide.urdf", wide);
        EXPECT_EQ(foam("evaluate wide.urdf wide.urdf").code, 0) << "as a model, too";
    }
}

} // namespace
} // namespace foam::test
