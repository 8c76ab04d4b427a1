// convert and formats: sphere models from any format to any other.
#include "program.hpp"

#include "support/shared_folder.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const arm = R"(<robot name="arm">
  <link name="base"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <link name="upper"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
  <link name="tool"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="0.5" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="upper"/><child link="tool"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.1" effort="1" velocity="1"/></joint>
</robot>
)";
const char* const table = "link,x,y,z,radius\nbase,0,0,0,0.125\nupper,0,0,1e-05,0.25\nupper,0,0,0,0.2109375\n";

class CliConvert : public Cli {
protected:
    void SetUp() override {
        write("arm.urdf", arm);
        write("model.csv", table);
    }
    std::string written(const std::string& arguments, const std::string& file) {
        const Outcome outcome = foam("convert " + arguments + " -o " + file + " --force");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return contents(path() / file);
    }
    std::string refusal(const std::string& arguments) {
        const Outcome outcome = foam("convert " + arguments);
        EXPECT_NE(outcome.code, 0);
        EXPECT_EQ(outcome.out, "");
        EXPECT_FALSE(std::filesystem::exists(path() / "out.yml")) << "nothing is half-written";
        return outcome.err;
    }
};

TEST_F(CliConvert, SaysWhatIsProved) {
    EXPECT_THAT(foam("convert model.csv -o a.json --format pyroki").out,
                HasSubstr("Nothing is proved without the robot's original geometry."));
    EXPECT_THAT(foam("convert model.csv arm.urdf -o a.xrdf --tool-frame tool").out,
                HasSubstr("Proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids, also in single "
                          "precision."));
    write("small.csv", "link,x,y,z,radius\nbase,0,0,0,0.09\nupper,0,0,0,0.2\n");
    EXPECT_THAT(foam("convert small.csv arm.urdf -o b.csv").out,
                HasSubstr("Proved in part: the collision geometry of 1 of 2"));
    const Outcome padded = foam("convert small.csv arm.urdf --pad 2cm -o c.csv");
    EXPECT_THAT(padded.err, HasSubstr("padding of 0.02 m: excess "));
    EXPECT_THAT(contents(path() / "c.csv"), HasSubstr("base,0,0,0,0.11\n"));
}

TEST_F(CliConvert, CuroboTakesOnlyTheKeysOfItsVersion) {
    const std::string args = "model.csv arm.urdf --format curobo --tool-frame tool --lock slide=0.05";
    const std::string now = written(args, "new.yml");
    EXPECT_THAT(now, HasSubstr("    tool_frames: [tool]\n"));
    EXPECT_THAT(now, HasSubstr("    format_version: 2.0\n"));
    EXPECT_THAT(now, HasSubstr("        - {center: [0.0, 0.0, 1.0e-05], radius: 0.25}\n")) << "a float for PyYAML";
    EXPECT_THAT(now, HasSubstr("    collision_sphere_buffer: 0.0\n")) << "cuRobo wants a float";
    EXPECT_THAT(now, HasSubstr("    self_collision_ignore: {base: [upper]}\n"));
    EXPECT_THAT(now, HasSubstr("    self_collision_buffer: {}\n")) << "null would crash cuRobo";
    EXPECT_THAT(now, HasSubstr("    collision_link_names: [base, upper]\n")) << "no link without spheres";
    EXPECT_THAT(now, HasSubstr("    lock_joints: {slide: 0.05}\n"));
    EXPECT_THAT(now, HasSubstr("joint_names: [turn, slide], default_joint_position: [0.5, 0.05]"))
        << "zero moved into the limits";
    EXPECT_THAT(now, Not(HasSubstr("ee_link")));
}

TEST_F(CliConvert, XrdfAndLulaAndPlainmp) {
    const std::string xrdf = written("model.csv arm.urdf --tool-frame tool --lock slide=0", "a.xrdf");
    EXPECT_THAT(xrdf, HasSubstr("format_version: 1.0\ndefault_joint_positions: {turn: 0.5, slide: 0.0}\n"));
    EXPECT_THAT(xrdf, HasSubstr("joint_names: [turn]"));
    EXPECT_THAT(xrdf, HasSubstr("self_collision:\n  geometry: foam_spheres\n  ignore: {base: [upper]}\n"));
    const std::string lula = written("model.csv arm.urdf --format lula --lock slide=0.1", "a.yaml");
    EXPECT_THAT(lula, HasSubstr("cspace_to_urdf_rules:\n  - {name: slide, rule: fixed, value: 0.1}\n"));
    EXPECT_THAT(lula, HasSubstr("collision_spheres:\n  - base:\n      - {center: [0.0, 0.0, 0.0], radius: 0.125}\n"));
    const std::string plainmp = written("model.csv arm.urdf --format plainmp", "b.yaml");
    EXPECT_THAT(plainmp, HasSubstr("self_collision_pairs: []\nonly_self_collision_links: [base]\n"))
        << "pairs that are checked";
}

TEST_F(CliConvert, IntoAFileKeepsEveryOtherByte) {
    const std::string mine =
        "# mine\nrobot_cfg:\n  kinematics:\n    base_link: base   # ours\n    collision_spheres:\n"
        "      base:\n      - center: [0, 0, 0]\n        radius: 1\n    # tuned\n    weights: [1, 2]\n"
        "    collision_link_names: [base]\n";
    write("mine.yml", mine);
    EXPECT_EQ(written("model.csv --format curobo --into mine.yml", "out.yml"),
              "# mine\nrobot_cfg:\n  kinematics:\n    base_link: base   # ours\n    collision_spheres:\n"
              "      base:\n        - {center: [0.0, 0.0, 0.0], radius: 0.125}\n      upper:\n"
              "        - {center: [0.0, 0.0, 1.0e-05], radius: 0.25}\n        - {center: [0.0, 0.0, 0.0], radius: "
              "0.2109375}\n"
              "    # tuned\n    weights: [1, 2]\n    collision_link_names: [base, upper]\n");
    EXPECT_EQ(contents(path() / "mine.yml"), mine);
    write("mine.srdf",
          "<robot name='arm'>\n  <!-- kept -->\n  <group name='g'/>\n"
          "  <link_sphere_approximation link='base'><sphere center='0 0 0' radius='1'/>"
          "</link_sphere_approximation>\n  <disable_collisions link1='a' link2='b' reason='User'/>\n</robot>\n");
    EXPECT_EQ(
        written("model.csv --format srdf --into mine.srdf", "out.srdf"),
        "<robot name='arm'>\n  <!-- kept -->\n  <group name='g'/>\n"
        "  <disable_collisions link1='a' link2='b' reason='User'/>\n"
        "  <link_sphere_approximation link=\"base\">\n    <sphere center=\"0 0 0\" radius=\"0.125\"/>\n"
        "  </link_sphere_approximation>\n  <link_sphere_approximation link=\"upper\">\n"
        "    <sphere center=\"0 0 1e-05\" radius=\"0.25\"/>\n    <sphere center=\"0 0 0\" radius=\"0.2109375\"/>\n"
        "  </link_sphere_approximation>\n</robot>\n");
}

TEST_F(CliConvert, AnSrdfHasThePairsOfElementsThatItCannotHold) {
    const Outcome run = foam("approximate arm.urdf -n 2 --with box -o run.srdf");
    EXPECT_EQ(run.code, 0) << run.err;
    const Outcome boxes = foam("approximate arm.urdf -n 2 --with box -o boxes.json");
    ASSERT_EQ(boxes.code, 0) << boxes.err;
    const Outcome outcome = foam("convert boxes.json arm.urdf -o boxes.srdf");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("SRDF has no elements but spheres: it has the pairs of links; not in the file: 2 boxes\n"));
    for (const char* file : {"run.srdf", "boxes.srdf"}) {
        EXPECT_THAT(contents(path() / file), HasSubstr("<disable_collisions link1=\"base\" link2=\"upper\""));
        EXPECT_THAT(contents(path() / file), HasSubstr("pairs for a model whose elements are in another file: foam"));
        EXPECT_THAT(contents(path() / file), Not(HasSubstr("link_sphere_approximation")));
    }
}

/// One link has no pairs: there is nothing to warn of.
TEST_F(CliConvert, OneLinkHasNoPairs) {
    write("one.urdf", "<robot name='one'><link name='base'><collision><geometry><box size='1 1 1'/></geometry></collision>"
                      "</link></robot>");
    const Outcome boxes = foam("approximate one.urdf -n 2 --with box -o one.srdf");
    EXPECT_EQ(boxes.code, 0);
    EXPECT_THAT(boxes.err, HasSubstr("SRDF has no elements but spheres: not in the file: 1 box\n"));
    EXPECT_THAT(boxes.err, Not(HasSubstr("pairs")));
    EXPECT_THAT(foam("spherize one.urdf -n 2 -o one.srdf --force").err, Not(HasSubstr("pairs")));
}

TEST_F(CliConvert, IntoAFileWithoutSpheres) {
    write("null.yml", "kinematics:\n  collision_spheres: null\n  collision_link_names: null # none\n");
    EXPECT_EQ(written("model.csv --format curobo --into null.yml", "out.yml"),
              "kinematics:\n  collision_spheres: {base: [{center: [0.0, 0.0, 0.0], radius: 0.125}], upper: [{center: "
              "[0.0, 0.0, 1.0e-05], radius: 0.25}, {center: [0.0, 0.0, 0.0], radius: 0.2109375}]}\n"
              "  collision_link_names: [base, upper] # none\n");
}

TEST_F(CliConvert, IntoAnXrdfWithSeveralGeometries) {
    const std::string begin =
        "format: xrdf\nworld_collision: {geometry: g}\nself_collision: {geometry: s}\ngeometry:\n";
    write("own.xrdf", begin + "  g: {spheres: {}}\n  s: {spheres: {}}\n");
    const Outcome outcome = foam("convert model.csv --format xrdf --into own.xrdf -o a.xrdf");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("own.xrdf:3: self_collision has a geometry of its own, 's', which stays as it is"));
    EXPECT_THAT(contents(path() / "a.xrdf"), HasSubstr("  s: {spheres: {}}\n"));
    write("clone.xrdf", begin + "  g:\n    clone: [s]\n    spheres: {}\n  s: {spheres: {}}\n");
    EXPECT_THAT(refusal("model.csv -o out.yml --format xrdf --into clone.xrdf"),
                HasSubstr("clone.xrdf:6:12: geometry 'g' clones others, whose spheres would stay beside the new ones; "
                          "remedy: delete 'clone'"));
}

TEST_F(CliConvert, TheirOwnFilesKeepAllButTheSpheres) {
    const std::filesystem::path theirs = shared_folder() / "reference_formats";
    if (!std::filesystem::exists(theirs)) {
        GTEST_SKIP() << theirs << " is not there";
    }
    for (const auto& [format, file] :
         {std::pair("curobo", "curobo/ur10e_v0.8.yml"), std::pair("xrdf", "xrdf/ur10e_1.0.xrdf"),
          std::pair("xrdf", "xrdf/ur10_2.0.xrdf"), std::pair("lula", "lula/ur5e_robot_description.yaml"),
          std::pair("plainmp", "plainmp/panda.yaml"), std::pair("bubblify", "bubblify/xarm6_rs_spherized.yml")}) {
        const std::string before = contents(theirs / file);
        const std::string in = "'" + (theirs / file).string() + "'";
        const std::string after = written(in + " --format " + format + " --into " + in, "theirs.out");
        // What is before and after the sections of spheres is the same.
        const std::size_t same = static_cast<std::size_t>(
            std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first - before.begin());
        const std::size_t at = std::min(before.find("spheres:"), before.find("collision_link_names:"));
        EXPECT_GE(same, at) << file;
        EXPECT_EQ(written("theirs.out --format " + std::string(format) + " --into theirs.out", "again.out"), after)
            << file << ": the second time nothing changes";
    }
}

TEST_F(CliConvert, VampGetsItsThreeFiles) {
    const Outcome outcome = foam("convert model.csv arm.urdf --format vamp -o arm_vamp.urdf --tool-frame tool");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Written: arm_vamp.urdf, arm_vamp.srdf, arm_vamp.json by write.vamp\n"));
    EXPECT_THAT(outcome.out,
                HasSubstr("Proved: the collision geometry of 2 of 2 links lies inside their spheres, as solids, also in "
                          "single precision."));
    EXPECT_THAT(contents(path() / "arm_vamp.srdf"), HasSubstr("<disable_collisions link1=\"base\" link2=\"upper\""));
    const auto job = nlohmann::json::parse(contents(path() / "arm_vamp.json"));
    EXPECT_EQ(job["urdf"], "arm_vamp.urdf");
    EXPECT_EQ(job["srdf"], "arm_vamp.srdf");
    EXPECT_EQ(job["end_effector"], "tool");
    EXPECT_EQ(foam("certify arm.urdf arm_vamp.urdf").code, 0) << "read back by read.urdf";
    EXPECT_EQ(written("arm_vamp.urdf arm.urdf", "back.csv"), contents(path() / "model.csv"));
    const std::string held = written("model.csv arm.urdf --format vamp --lock slide=0.05", "held.urdf");
    EXPECT_THAT(held, HasSubstr("<joint name=\"slide\" type=\"fixed\">"));
    EXPECT_THAT(held, HasSubstr("<origin xyz=\"0 0 0.05\" rpy=\"0 0 0\"/>"));
}

TEST_F(CliConvert, SpherizeAndRunWriteAllFilesOfVamp) {
    EXPECT_THAT(foam("spherize arm.urdf -n 4 --format vamp -o s.urdf --set 'robot.tool_frames=[tool]'").out,
                HasSubstr("Written: s.urdf, s.srdf, s.json ("));
    EXPECT_EQ(nlohmann::json::parse(contents(path() / "s.json"))["urdf"], "s.urdf");
    EXPECT_EQ(foam("certify arm.urdf s.urdf").code, 0);
    EXPECT_THAT(foam("spherize arm.urdf -n 4 --format vamp -o -").err,
                HasSubstr("write.vamp writes several files; remedy: -o FILE"));
    const std::string begin = "foam: 1\nname: arm\nrobot: {urdf: [arm.urdf]}\nstages: [spherize.grid]\noutputs:\n";
    write("vamp.yaml", begin + "  - write.vamp: {file: vamp/arm.urdf}\n");
    EXPECT_EQ(foam("run vamp.yaml --run-dir run").code, 0);
    EXPECT_TRUE(std::filesystem::exists(path() / "run/vamp/arm.srdf"));
    EXPECT_EQ(nlohmann::json::parse(contents(path() / "run/manifest.json"))["outputs"].size(), 3u);
    EXPECT_EQ(foam("verify run").code, 0);
    write("twice.yaml", begin + "  - write.srdf: {file: arm.srdf}\n  - write.vamp: {file: arm.urdf}\n");
    EXPECT_THAT(foam("check twice.yaml").err + foam("check twice.yaml").out,
                HasSubstr("output file 'arm.srdf' collides with 'arm.srdf' of line 6"));
    write("same.yaml", begin + "  - write.vamp: {file: arm.json}\n");
    EXPECT_THAT(
        foam("check same.yaml").err + foam("check same.yaml").out,
        HasSubstr("write.vamp writes other files beside 'arm.json', one of them under the same name; remedy: a file "
                  "that ends in .urdf"));
}

TEST_F(CliConvert, SetsParametersOfTheWriter) {
    const std::string args = "model.csv arm.urdf --format curobo --tool-frame tool ";
    EXPECT_THAT(written(args + "--set version=0.7 --set buffer=1cm", "old.yml"),
                HasSubstr("collision_sphere_buffer: 0.01\n"));
    EXPECT_THAT(written("model.csv arm.urdf --set drake=true --set mu_static=0.5", "drake.urdf"),
                HasSubstr("<drake:ignored_collision_filter_group name=\"foam_upper\"/>"));
    EXPECT_THAT(refusal(args + "-o out.yml --set versoin=0.7"),
                HasSubstr("--set: write.curobo has no parameter 'versoin'; did you mean 'version'?"));
    EXPECT_THAT(refusal(args + "-o out.yml --set version=0.6"),
                HasSubstr("--set: 'version' of write.curobo expects one of 0.8, 0.7, got \"0.6\""));
    EXPECT_THAT(refusal(args + "-o out.yml --set pairs=maybe"),
                HasSubstr("--set: 'pairs' of write.curobo expects one of keep, merge, replace, got \"maybe\""));
    EXPECT_THAT(refusal(args + "-o out.yml --set version"), HasSubstr("--set expects KEY=VALUE, got 'version'"));
}

TEST_F(CliConvert, RenamesLinks) {
    write("theirs.csv", "link,x,y,z,radius\nmy_base,0,0,0,0.125\nmy_upper,0,0,0,0.25\n");
    EXPECT_THAT(refusal("theirs.csv arm.urdf -o out.yml --format bubblify"), HasSubstr("link 'my_base' is no link of"));
    EXPECT_EQ(written("theirs.csv arm.urdf --rename my_=", "ours.csv"),
              "link,x,y,z,radius\nbase,0,0,0,0.125\nupper,0,0,0,0.25\n");
    EXPECT_THAT(refusal("theirs.csv arm.urdf -o out.yml --format bubblify --rename mi_="),
                HasSubstr("--rename mi_=: no link of the spheres is called 'mi_' or begins with it"));
}

TEST_F(CliConvert, MassesComeFromTheGeometry) {
    const Outcome outcome = foam("convert model.csv arm.urdf --format urdf --set inertial=moving -o heavy.urdf -v");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err,
                HasSubstr("note: <inertial> of the collision geometry at 1000 kg/m³ is written for upper\n"));
    EXPECT_THAT(contents(path() / "heavy.urdf"), HasSubstr("<mass value=\"33.510321638291")) << "4/3 π 0.2³ 1000";
    EXPECT_THAT(written("model.csv arm.urdf --format mjcf --tool-frame tool --lock slide=0", "arm.xml"),
                HasSubstr("mass=\"33.510321638291"));
}

TEST_F(CliConvert, Refusals) {
    EXPECT_THAT(refusal("model.csv -o out.yml --format curobo"), HasSubstr("write.curobo needs the robot"));
    EXPECT_THAT(refusal("model.csv -o out.xml --format mjcf"), HasSubstr("write.mjcf needs the robot")) << "two links";
    EXPECT_THAT(refusal("model.csv arm.urdf -o out.yml --format curobo --tool-frame tool --lock sldie=1"),
                HasSubstr("--lock: arm.urdf has no joint 'sldie'; did you mean 'slide'?"));
    EXPECT_THAT(refusal("model.csv arm.urdf -o out.yml --format curobo --tool-frame tool --lock slide"),
                HasSubstr("--lock expects JOINT=NUMBER"));
    EXPECT_THAT(refusal("model.csv arm.urdf -o out.yml --format curobo --tool-frame tool --base-link upper"),
                HasSubstr("link 'base' has spheres, but is not below the base link 'upper'"));
    EXPECT_THAT(refusal("model.csv arm.urdf -o out.yml --format curobo --tool-frame tol"),
                HasSubstr("--tool-frame 'tol' names no link of arm.urdf; did you mean 'tool'?"));
    EXPECT_THAT(refusal("model.csv arm.urdf -o out.yml --format curobo --tool-frame tool --base-link bas"),
                HasSubstr("base_link: the robot has no link 'bas'; did you mean 'base'?"));
    EXPECT_THAT(refusal("model.csv -o out.yml"), HasSubstr("several formats write .yml: "));
    EXPECT_THAT(refusal("model.csv -o out.yml --format curbo"), HasSubstr("did you mean 'curobo'?"));
    EXPECT_THAT(refusal("model.csv -o out.yml --format morphit"), HasSubstr("holds the spheres of one body"));
    EXPECT_THAT(refusal("model.csv -o out.yml --format urdf"), HasSubstr("the robot has no URDF text"));
    EXPECT_THAT(refusal("model.csv -o out.yml --format pyroki --into model.csv"), HasSubstr("writes whole files"));
    EXPECT_THAT(refusal("model.csv -o out.yml --format bubblify --into arm.urdf"), HasSubstr("arm.urdf:"));
    EXPECT_THAT(refusal("model.csv -o model.csv"), HasSubstr("model.csv"));
    EXPECT_THAT(refusal("model.csv -o out.yml --format bubblify --pad=-1cm"), HasSubstr("--pad"));
    write("other.csv", "link,x,y,z,radius\nuper,0,0,0,1\n");
    EXPECT_THAT(refusal("other.csv arm.urdf -o out.yml --format bubblify"),
                HasSubstr("link 'uper' is no link of arm.urdf; did you mean 'upper'?"));
}

TEST_F(CliConvert, FormatsAreListed) {
    const Outcome outcome = foam("formats --json");
    ASSERT_EQ(outcome.code, 0);
    const auto formats = nlohmann::json::parse(outcome.out);
    const auto curobo =
        std::find_if(formats.begin(), formats.end(), [](const auto& f) { return f["format"] == "curobo"; });
    ASSERT_NE(curobo, formats.end());
    EXPECT_TRUE((*curobo)["reads"] && (*curobo)["writes"] && (*curobo)["into"] && (*curobo)["lists_pairs"] &&
                (*curobo)["float32"]);
    EXPECT_THAT(foam("formats").out, HasSubstr("\ncurobo "));
    EXPECT_THAT(foam("formats").out, HasSubstr("\nurdf               yes   yes    -     drake  urdfdom"));
    EXPECT_THAT(foam("describe write.vamp").out, HasSubstr("Files: .urdf, and under the same name .srdf .json\n"));
}

} // namespace
} // namespace foam::test
