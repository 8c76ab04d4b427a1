// The options that commands with a robot share.
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <set>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

/// 0.95 m long; two fingers, of which one follows the other.
const char* const gripper = R"(<robot name="gripper">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.4"/></geometry></collision></link>
  <link name="hand"><collision><geometry><box size="0.2 0.1 0.2"/></geometry></collision></link>
  <link name="finger left"><collision><geometry><box size="0.02 0.02 0.1"/></geometry></collision></link>
  <link name="finger_right"><collision><geometry><box size="0.02 0.02 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="hand"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="open" type="prismatic"><parent link="hand"/><child link="finger left"/><origin xyz="0.05 0 0.2"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="other" type="prismatic"><parent link="hand"/><child link="finger_right"/><origin xyz="-0.05 0 0.2"/>
    <axis xyz="-1 0 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/><mimic joint="open"/></joint>
</robot>
)";

class CliRobotOptions : public Cli {
protected:
    void SetUp() override {
        write("gripper.urdf", gripper);
        write("box.obj", box_obj);
    }
    /// Returns the links with elements in the JSON that `foam spherize` writes.
    std::set<std::string> links_of(const std::string& arguments) {
        const Outcome outcome = foam("spherize gripper.urdf -n 12 -m grid --force -o out.json " + arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        std::set<std::string> links;
        const json made = json::parse(contents(path() / "out.json"));
        for (const auto& [link, elements] : made["links"].items()) {
            links.insert(link);
        }
        return links;
    }
    std::string refusal(const std::string& arguments) {
        const Outcome outcome = foam(arguments);
        EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.err;
        EXPECT_EQ(outcome.out, "");
        return outcome.err;
    }
};

TEST_F(CliRobotOptions, LinksAreKeptAndSkipped) {
    using Links = std::set<std::string>;
    EXPECT_EQ(links_of("--skip 'finger*'"), (Links{"base", "hand"}));
    EXPECT_EQ(links_of("--skip 'finger left' --skip base"), (Links{"hand", "finger_right"}));
    EXPECT_EQ(links_of("--keep 'finger*' --keep hand"), (Links{"hand", "finger left", "finger_right"}));
    EXPECT_EQ(links_of("--keep 'finger*' --keep base --skip '*left'"), (Links{"base", "finger_right"}));
    EXPECT_EQ(links_of("--skip base --keep base --keep hand"), (Links{"hand"})) << "whatever the order";
    EXPECT_EQ(links_of("--keep '*' --skip hand --skip hand"), (Links{"base", "finger left", "finger_right"}));
    const Outcome outcome = foam("spherize gripper.urdf -n 4 -m grid --keep base -o out.urdf");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(contents(path() / "out.urdf"), HasSubstr("<box size=\"0.2 0.1 0.2\"/>")) << "the old geometry stays";
    EXPECT_THAT(contents(path() / "out.urdf"), Not(HasSubstr("<box size=\"0.2 0.2 0.4\"/>")));
}

TEST_F(CliRobotOptions, AGlobThatMatchesNothingIsAnErrorBeforeTheSearch) {
    for (const char* command : {"spherize gripper.urdf -n 9", "approximate gripper.urdf -n 9", "info gripper.urdf",
                                "evaluate gripper.urdf gripper.urdf", "certify gripper.urdf gripper.urdf",
                                "self-collision gripper.urdf", "gallery gripper.urdf 4",
                                "view gripper.urdf --html page.html", "compare gripper.urdf gripper.urdf"}) {
        const std::string words = command;
        EXPECT_THAT(refusal(words + " --skip hnad"),
                    HasSubstr("--skip 'hnad' matches no link of gripper.urdf; did you mean 'hand'?"));
        EXPECT_THAT(refusal(words + " --keep 'fingr*'"), HasSubstr("--keep 'fingr*' matches no link of gripper.urdf; "
                                                                  "did you mean 'finger left'?"));
        EXPECT_THAT(refusal(words + " --skip xyzzy"), HasSubstr("there are: base, hand, finger left, finger_right"));
        EXPECT_THAT(refusal(words + " --skip ''"), HasSubstr("--skip expects a name"));
        EXPECT_THAT(refusal(words + " --keep base --skip 'b*'"), HasSubstr("leave no link of gripper.urdf"));
    }
    EXPECT_THAT(refusal("spherize gripper.urdf -n 9 --weight 'hnd=2'"), HasSubstr("did you mean 'hand'?"));
    EXPECT_THAT(refusal("spherize box.obj -n 9 --skip box"), HasSubstr("box.obj is a mesh, which has no links"));
    EXPECT_FALSE(std::filesystem::exists(path() / "gripper_spheres.urdf"));
}

TEST_F(CliRobotOptions, WeightsMoveTheBudget) {
    const auto spheres_of_hand = [&](const std::string& arguments) {
        const Outcome outcome = foam("spherize gripper.urdf -n 20 -m grid -o out.csv --json " + arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const json printed = json::parse(outcome.out);
        for (const auto& link : printed["links"]) {
            if (link["link"] == "hand") {
                return link["spheres"].get<int>();
            }
        }
        return 0;
    };
    EXPECT_GT(spheres_of_hand("--weight hand=1000"), spheres_of_hand("--weight 'h*=0.001'"));
    EXPECT_EQ(spheres_of_hand("--weight '*=1000' --weight hand=1e-6"), spheres_of_hand("--weight hand=1e-6"));
    EXPECT_GT(spheres_of_hand("--keep hand --keep base --weight '*=0.001' --weight hand=1000"),
              spheres_of_hand("--keep hand --keep base --weight hand=1000 --weight '*=0.001'")) << "the last counts";
    for (const char* wrong : {"hand=0", "hand=-1", "hand=2e6"}) {
        EXPECT_THAT(refusal(std::string("spherize gripper.urdf -n 9 --weight ") + wrong),
                    HasSubstr(std::string("--weight expects a factor above 0 and at most 1000000, got '") + wrong));
    }
    for (const char* wrong : {"hand", "hand=", "=2", "hand=x", "hand=nan"}) {
        EXPECT_THAT(refusal(std::string("spherize gripper.urdf -n 9 --weight ") + wrong), HasSubstr("--weight expects"));
    }
    EXPECT_THAT(refusal("spherize gripper.urdf -n 9 --weight hand=1 --weight hand=2"), HasSubstr("twice for 'hand'"));
    EXPECT_THAT(refusal("spherize gripper.urdf --weight hand=2"), HasSubstr("remedy: -n N, or --excess X"));
}

TEST_F(CliRobotOptions, JointsAreLocked) {
    for (const char* command : {"spherize gripper.urdf -n 9", "self-collision gripper.urdf", "gallery gripper.urdf 4",
                                "view gripper.urdf --html page.html",
                                "evaluate gripper.urdf gripper.urdf --poses 10"}) {
        const std::string words = command;
        EXPECT_THAT(refusal(words + " --lock opne=0"), HasSubstr("has no joint 'opne'; did you mean 'open'?"));
        EXPECT_THAT(refusal(words + " --lock open=4"),
                    HasSubstr("joint 'open' moves from 0 to 0.04 m, and 4 is outside"));
        EXPECT_THAT(refusal(words + " --lock turn=-1.5"), HasSubstr("joint 'turn' moves from -1 to 2 rad"));
        EXPECT_THAT(refusal(words + " --lock other=0"), HasSubstr("follows joint 'open'; remedy: hold that one"));
        EXPECT_THAT(refusal(words + " --lock open"), HasSubstr("--lock expects JOINT=NUMBER"));
        EXPECT_THAT(refusal(words + " --lock open=nan"), HasSubstr("--lock"));
        EXPECT_THAT(refusal(words + " --lock open=0 --lock open=0.01"), HasSubstr("twice for joint 'open'"));
    }
    EXPECT_THAT(refusal("evaluate gripper.urdf gripper.urdf --lock open=0"), HasSubstr("remedy: --poses 1000"));
    EXPECT_THAT(foam("spherize gripper.urdf -n 9 --lock open=0.03 --print-recipe").out,
                HasSubstr("lock_joints: {\"open\": 0.03}"));
    const auto pairs = [&](const std::string& arguments) {
        const Outcome outcome = foam("self-collision gripper.urdf --samples 1000 --json " + arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return json::parse(outcome.out)["pairs"];
    };
    EXPECT_EQ(pairs("").size(), 6u);
    EXPECT_EQ(pairs("--skip base").size(), 3u);
    for (const auto& pair : pairs("--lock open=0.03")) {
        if (pair["link1"] == "finger left" && pair["link2"] == "finger_right") {
            EXPECT_TRUE(pair["proved"]) << "nothing moves between the fingers";
        }
    }
}

TEST_F(CliRobotOptions, PicturesShowWhatIsChosen) {
    const auto picture = [&](const std::string& arguments) {
        const Outcome outcome = foam("gallery gripper.urdf 4 --size 300x100 --force -o a.png " + arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return contents(path() / "a.png");
    };
    const std::string usual = picture("");
    EXPECT_NE(picture("--lock turn=1"), usual);
    EXPECT_EQ(picture("--lock turn=0"), usual);
    EXPECT_NE(picture("--skip base"), usual);
    EXPECT_EQ(picture("--keep '*'"), usual);
    const Outcome page = foam("view gripper.urdf -n 4 --keep hand --html page.html");
    EXPECT_EQ(page.code, 0) << page.err;
}

TEST_F(CliRobotOptions, TheToolFrameIsTheOneTip) {
    std::string one_tip = gripper;
    one_tip = one_tip.substr(0, one_tip.find("  <link name=\"finger left\">")) +
              one_tip.substr(one_tip.find("  <joint name=\"turn\""), one_tip.find("  <joint name=\"open\"") -
                                                                        one_tip.find("  <joint name=\"turn\"")) +
              "</robot>\n";
    write("arm.urdf", one_tip);
    for (const char* format : {"curobo", "xrdf", "vamp"}) {
        const std::string words = std::string(" --format ") + format + " --force -o arm." +
                                  (std::string(format) == "vamp" ? "v.urdf" : format);
        const Outcome outcome = foam("spherize arm.urdf -n 4 -m grid" + words);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("note: the tool frame is 'hand', the only tip of the robot"));
        const Outcome asked = foam("spherize gripper.urdf -n 400 --effort best" + words);
        EXPECT_EQ(asked.code, 2);
        EXPECT_THAT(asked.err, HasSubstr("the last links of the robot are finger left, finger_right; remedy: "
                                         "--tool-frame LINK"));
        EXPECT_THAT(refusal("spherize gripper.urdf -n 4 --tool-frame hnad" + words), HasSubstr("did you mean 'hand'?"));
    }
    ASSERT_EQ(foam("spherize arm.urdf -n 4 -m grid -o model.csv").code, 0);
    const Outcome converted = foam("convert model.csv arm.urdf --format curobo -o arm.yml");
    EXPECT_EQ(converted.code, 0) << converted.err;
    EXPECT_THAT(converted.err, HasSubstr("note: the tool frame is 'hand'"));
    EXPECT_THAT(foam("spherize arm.urdf -n 4 -m grid -o arm.csv").err, Not(HasSubstr("tool frame")));
}

TEST_F(CliRobotOptions, ConvertLeavesLinksOut) {
    ASSERT_EQ(foam("spherize gripper.urdf -n 8 -m grid -o model.csv").code, 0);
    ASSERT_EQ(foam("convert model.csv gripper.urdf --skip 'finger*' -o out.csv").code, 0);
    EXPECT_THAT(contents(path() / "out.csv"), Not(HasSubstr("\nfinger")));
    ASSERT_EQ(foam("convert model.csv --keep hand -o out.csv --force").code, 0) << "the names of the model do";
    EXPECT_THAT(contents(path() / "out.csv"), Not(HasSubstr("\nbase")));
    EXPECT_THAT(refusal("convert model.csv gripper.urdf --keep hnad -o o.csv"), HasSubstr("did you mean 'hand'?"));
    EXPECT_THAT(refusal("convert model.csv --keep hnad -o o.csv"), HasSubstr("did you mean 'hand'?"));
    const Outcome judged = foam("evaluate gripper.urdf model.csv --skip 'finger*' --json");
    ASSERT_EQ(judged.code, 0) << judged.err;
    EXPECT_EQ(json::parse(judged.out)["links"].size(), 2u);
    EXPECT_EQ(foam("evaluate gripper.urdf model.csv --link base --keep hand --json").out,
              foam("evaluate gripper.urdf model.csv --keep hand --keep base --json").out) << "the old spelling";
}

TEST_F(CliRobotOptions, PaddingIsOneOption) {
    const Outcome made = foam("spherize gripper.urdf -n 8 -m grid --pad 1cm -o model.csv");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(foam("spherize gripper.urdf -n 8 --pad 10mm --print-recipe").out, HasSubstr("pad: 0.01m\n"));
    const Outcome judged = foam("evaluate gripper.urdf model.csv --pad 3cm --json");
    ASSERT_EQ(judged.code, 0) << judged.err;
    EXPECT_GT(json::parse(judged.out)["total"]["excess"],
              json::parse(foam("evaluate gripper.urdf model.csv --json").out)["total"]["excess"]);
    for (const char* command : {"spherize gripper.urdf -n 8 -o a.csv", "convert model.csv gripper.urdf -o o.csv",
                                "certify gripper.urdf model.csv", "batch '*.obj' -n 2 --run-dir made"}) {
        EXPECT_THAT(refusal(std::string(command) + " --pad=-1cm"), HasSubstr("--pad expects a length of at least 0"));
        EXPECT_THAT(refusal(std::string(command) + " --pad 1km"), HasSubstr("--pad expects a number in m"));
    }
}

TEST_F(CliRobotOptions, ALengthAboveTheRobotIsQuestioned) {
    ASSERT_EQ(foam("spherize gripper.urdf -n 8 -m grid -o model.csv").code, 0);
    const auto said = [&](const std::string& arguments) { return foam(arguments).err; };
    EXPECT_THAT(said("spherize gripper.urdf -n 8 -m grid -o a.csv --pad 5"),
                HasSubstr("warning: pad is 5 m, larger than the whole input (950 mm); if it is in millimetres: 5mm\n"));
    EXPECT_THAT(said("spherize gripper.urdf -n 8 -m grid -o a.csv --pad 5m"), Not(HasSubstr("larger than")));
    EXPECT_THAT(said("spherize gripper.urdf -n 8 -m grid -o a.csv --max-protrusion 5"),
                HasSubstr("max_protrusion is 5 m, larger than the whole input (950 mm): it has no effect"));
    EXPECT_THAT(said("convert model.csv gripper.urdf -o b.csv --pad 5"),
                HasSubstr("warning: --pad is 5 m, larger than the robot (950 mm); if it is in millimetres: 5mm\n"));
    EXPECT_THAT(said("evaluate gripper.urdf model.csv --pad 5"), HasSubstr("warning: --pad is 5 m"));
    EXPECT_THAT(said("evaluate gripper.urdf model.csv --clip base=0,0,1,30"),
                HasSubstr("warning: OFFSET of --clip is 30 m, larger than the robot"));
    EXPECT_THAT(said("evaluate gripper.urdf model.csv --clip base=0,0,1,30mm"), Not(HasSubstr("larger than")));
    EXPECT_THAT(said("spherize gripper.urdf -n 8 -m grid -o c.csv --set links.hand.max_protrusion=3"),
                HasSubstr("max_protrusion is 3 m"));
}

TEST_F(CliRobotOptions, AnOptionWithoutMeaningNamesTheCommandsThatHaveIt) {
    EXPECT_THAT(refusal("info gripper.urdf --weight hand=2"),
                HasSubstr("foam info has no option '--weight'; foam spherize, foam approximate"));
    EXPECT_THAT(refusal("batch box.obj -n 2 --run-dir made --skip hand"),
                HasSubstr("foam batch has no option '--skip'"));
    EXPECT_THAT(refusal("info gripper.urdf --skipp hand"),
                HasSubstr("unknown option '--skipp'; did you mean '--skip'?"));
}

} // namespace
} // namespace foam::test
