// foam self-collision as a user runs it.
#include "cli/program.hpp"

#include <nlohmann/json.hpp>

#include <tuple>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr const char* arm_text = R"(<robot name="arm">
  <link name="base"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.2"/></geometry></collision></link>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="hand"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

class SelfCollisionCli : public Cli {
protected:
    SelfCollisionCli() { write("arm.urdf", arm_text); }
};

TEST_F(SelfCollisionCli, ATableWithReasons) {
    const Outcome outcome = foam("self-collision arm.urdf --samples 2000 --proof-boxes 200");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out, HasSubstr("arm.urdf: its own spheres\n"
                                       "link   link   reason    evidence\n"
                                       "base   upper  Adjacent  joined\n"
                                       "base   hand   (check)   touch in "));
    EXPECT_THAT(outcome.out, HasSubstr("\nupper  hand   Adjacent  joined\n"
                                       "3 pairs: 2 adjacent, 0 always touching, 0 never touching; 0 proved; 1 to check.\n"));
}

TEST_F(SelfCollisionCli, SamplesComeWithTheirBound) {
    std::string narrow = arm_text;
    narrow.replace(narrow.find("upper=\"3\""), 9, "upper=\"1\"");
    write("narrow.urdf", narrow);
    EXPECT_THAT(foam("self-collision narrow.urdf").out, HasSubstr("\nbase   hand   Never     proved\n"));
    const Outcome outcome = foam("self-collision narrow.urdf --proof-boxes 0 --samples 1000 --confidence 0.99");
    EXPECT_THAT(outcome.out, HasSubstr("\nbase   hand   Never     touch in 0 of 1000: in less than 0.459 %\n"));
    EXPECT_THAT(outcome.out, HasSubstr("Never by samples: at 99 % confidence less than 0.459 % of the configurations "
                                       "for one pair, 0.459 % for all 1 such pairs at once.\n"));
}

/// Random configurations never find a gap that is there at the limits of three joints alone.
TEST_F(SelfCollisionCli, GeometryThatIsFreeAtTheLimitsIsChecked) {
    std::string text = "<robot name='g'><link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
                       "<link name='m0'/><link name='m1'/>"
                       "<link name='c'><collision><geometry><box size='1 1 1'/></geometry></collision></link>";
    for (const auto& [name, parent, child, x] :
         {std::tuple{"j0", "a", "m0", "1.02"}, {"j1", "m0", "m1", "0"}, {"j2", "m1", "c", "0"}}) {
        text += std::string("<joint name='") + name + "' type='prismatic'><parent link='" + parent + "'/><child link='" + child +
                "'/><origin xyz='" + x + " 0 0'/><axis xyz='-1 0 0'/><limit lower='0' upper='0.3' effort='1' velocity='1'/></joint>";
    }
    write("gap.urdf", text + "</robot>");
    EXPECT_THAT(foam("self-collision gap.urdf").out, HasSubstr("a      c      (check)"));
}

TEST_F(SelfCollisionCli, FilesForPlanners) {
    const Outcome outcome = foam("self-collision arm.urdf --samples 100 --srdf arm.srdf --curobo ignore.yaml");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(contents(path() / "arm.srdf"),
              "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
              "<robot name=\"arm\">\n"
              "  <disable_collisions link1=\"base\" link2=\"upper\" reason=\"Adjacent\"/>\n"
              "  <disable_collisions link1=\"upper\" link2=\"hand\" reason=\"Adjacent\"/>\n"
              "</robot>\n");
    EXPECT_EQ(contents(path() / "ignore.yaml"),
              "self_collision_ignore:\n  \"base\": [\"upper\"]\n  \"upper\": [\"hand\"]\n");
}

TEST_F(SelfCollisionCli, JsonIsTheSameOnAnyNumberOfThreads) {
    const std::string command = "self-collision arm.urdf --json --samples 5000 --pose elbow=3 --by-pose --seed ";
    const Outcome one = foam(command + "3 -j 1");
    EXPECT_EQ(one.code, 0);
    EXPECT_EQ(one.err,
              "foam: warning: reference pose (as given): elbow 3; the geometry of these links touches in it: base and "
              "hand\n"
              "foam: warning: --by-pose leaves out pairs that touch in the given pose; contacts of these links in other "
              "poses are missed: base and hand\n");
    EXPECT_EQ(foam(command + "3 -j 3").out, one.out);
    EXPECT_NE(foam(command + "4").out, one.out);
    EXPECT_EQ(json::parse(foam("self-collision arm.urdf --json --pose elbow=3").out)["pairs"][1]["ignored"], false);
    const json data = json::parse(one.out);
    EXPECT_EQ(data["spheres_from"], "its own spheres");
    EXPECT_EQ(data["reference_pose"], json({{"elbow", 3.0}, {"shoulder", 0.0}}));
    ASSERT_EQ(data["pairs"].size(), 3u);
    const json& hand = data["pairs"][1];
    EXPECT_EQ(hand["link2"], "hand");
    EXPECT_EQ(hand["reason"], "Default");
    EXPECT_EQ(hand["ignored"], true);
    EXPECT_EQ(hand["proved"], false);
    EXPECT_GE(hand["samples"], 2048);
    EXPECT_GT(hand["contacts"], 0);
    EXPECT_EQ(data["links"][0], json({{"link", "base"}, {"spheres", 1}, {"certified_cover", false}}));
}

TEST_F(SelfCollisionCli, OtherGeometryIsCoveredFirst) {
    std::string boxes = arm_text;
    boxes.replace(boxes.find("<sphere radius=\"0.3\"/>"), 22, "<box size=\"0.2 0.2 0.2\"/>");
    write("boxes.urdf", boxes);
    const Outcome outcome = foam("self-collision boxes.urdf --samples 100 --spheres 2");
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(outcome.out,
                HasSubstr("boxes.urdf: certified models of at most 2 spheres for 1 link, its own spheres for 2\n"));
    EXPECT_TRUE(json::parse(
        foam("self-collision boxes.urdf --samples 100 --spheres 2 --json").out)["links"][0]["certified_cover"]);
}

TEST_F(SelfCollisionCli, SpheresOfAFile) {
    write("model.csv", "link,x,y,z,radius\nbase,0,0,0,0.4\nhand,1,0,0,0.3\n");
    const Outcome outcome = foam("self-collision arm.urdf --model model.csv --samples 100");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "foam: warning: arm.urdf: 1 of 3 links with collision geometry have no spheres: upper\n");
    EXPECT_THAT(outcome.out, HasSubstr("arm.urdf: the spheres of model.csv\n"));
    EXPECT_THAT(outcome.out, HasSubstr("1 pair: "));
}

TEST_F(SelfCollisionCli, AgainstTheListOfAnother) {
    const std::string command = "self-collision arm.urdf --samples 1000 --proof-boxes 200 --against ";
    write("theirs.srdf", "<robot name='arm'>\n<group name='all'/>\n"
                         "<disable_collisions link1='upper' link2='base' reason='Adjacent'/>\n"
                         "<disable_collisions link1='base' link2='hand' reason='Never'/>\n"
                         "<disable_collisions link1='base' link2='camera' reason='User'/></robot>\n");
    EXPECT_THAT(foam(command + "theirs.srdf").out,
                HasSubstr("theirs.srdf excludes 3 pairs: 1 of them are excluded here, 1 need a check here, 1 contain "
                          "links without spheres; 1 more are excluded here.\n"
                          "  to check here: base, hand (Never): touch in "));
    const json against = json::parse(foam(command + "theirs.srdf --json").out)["against"];
    EXPECT_EQ(against["both"], 1);
    EXPECT_EQ(against["only_there"].dump(), R"([["base","hand"]])");
    EXPECT_EQ(against["only_here"].dump(), R"([["upper","hand"]])");
    EXPECT_EQ(against["without_spheres"].dump(), R"([["base","camera"]])");
    for (const char* text : {"self_collision_ignore: {base: [upper], upper: [base, hand], hand: null}\n",
                             "robot_cfg: {kinematics: {self_collision_ignore: {base: [upper], hand: [upper]}}}\n",
                             "format: xrdf\nself_collision: {ignore: {base: [upper], hand: [upper]}}\n"}) {
        write("theirs.yaml", text);
        EXPECT_THAT(foam(command + "theirs.yaml").out,
                    HasSubstr("theirs.yaml excludes 2 pairs: 2 of them are excluded here, 0 need a check here, 0 "
                              "contain links without spheres; 0 more are excluded here.\n"));
    }
}

TEST_F(SelfCollisionCli, ListsThatCannotBeRead) {
    const auto refusal = [&](const std::string& text) {
        write("theirs", text);
        const Outcome outcome = foam("self-collision arm.urdf --samples 10 --proof-boxes 0 --against theirs");
        EXPECT_EQ(outcome.code, 1);
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    };
    EXPECT_EQ(refusal("<robot>\n<disable_collisions link1='base'/></robot>"),
              "foam: error: theirs:2: <disable_collisions> does not name two links; remedy: <disable_collisions "
              "link1=\"A\" link2=\"B\"/>\n");
    EXPECT_EQ(refusal("<robot>\n<link></robot>"),
              "foam: error: theirs:2:9: XML: mismatched tag; remedy: close each <NAME> by </NAME>, the inner "
              "ones first\n");
    EXPECT_EQ(refusal("links: {}\n"),
              "foam: error: theirs: it excludes no pairs of links; supported are the <disable_collisions> of SRDFs, "
              "cuRobo's self_collision_ignore and XRDF's self_collision\n");
    EXPECT_EQ(refusal("self_collision_ignore: {base: upper}\n"),
              "foam: error: theirs:1:31: expected a list of links, got the text 'upper'\n");
}

TEST_F(SelfCollisionCli, Refusals) {
    write("one.urdf", "<robot name='one'><link name='a'><collision><geometry><sphere radius='1'/></geometry>"
                      "</collision></link></robot>");
    write("box.obj", box_obj);
    const auto refusal = [&](const std::string& arguments, int code) {
        const Outcome outcome = foam("self-collision " + arguments);
        EXPECT_EQ(outcome.code, code) << arguments;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    };
    EXPECT_EQ(refusal("one.urdf", 1),
              "foam: error: one.urdf: only one link has collision geometry: there is no pair of links to check\n");
    EXPECT_EQ(refusal("box.obj", 1), "foam: error: box.obj: a mesh has no joints; remedy: give a URDF\n");
    EXPECT_EQ(refusal("arm.urdf --pose elbow", 2), "foam: error: --pose expects JOINT=NUMBER, in rad or m, got 'elbow'\n");
    EXPECT_EQ(refusal("arm.urdf --pose wrist=1", 2), "foam: error: --pose: arm.urdf has no joint 'wrist'\n");
    EXPECT_EQ(refusal("arm.urdf --confidence 1", 2), "foam: --confidence: expects a number between 0 and 1, got '1'\n"
              "foam: `foam self-collision --help` explains its use\n");
    EXPECT_EQ(refusal("arm.urdf --samples 10 --srdf no/such/folder/a.srdf", 1),
              "foam: error: no/such/folder/a.srdf: it cannot be written; remedy: check that its folder exists and has "
              "room\n");
}

} // namespace
} // namespace foam::test
