// write.mjcf with `into`: the user's own file keeps every byte but the spheres, and the pairs on request.
#include "models.hpp"
#include "support/read_spheres.hpp"
#include "support/temporary_folder.hpp"

#include <foam/sdk/stage.hpp>

#include <gmock/gmock.h>

#include <fstream>

namespace foam::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* theirs = R"(<mujoco model="arm">
  <!-- tuned for years -->
  <default>
    <default class="visual"><geom contype="0" conaffinity="0" group="2"/></default>
    <default class="hull"><geom type="mesh" group="3" friction="0.3"/></default>
  </default>
  <worldbody>
    <geom name="floor" type="plane" size="1 1 .1"/>
    <body name="first">
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
      <geom class="visual" size="0.5"/>
      <geom class="hull" mesh="a"/>
      <!-- between -->
      <geom class="hull" mesh="b"/>
      <geom size="0.2" pos="1 0 0"/>
      <body name="second">
        <joint name="j"/>
        <geom size="0.1"/>
      </body>
      <body name="camera"><geom size="0.03"/></body>
    </body>
  </worldbody>
  <contact>
    <pair geom1="floor" geom2="floor"/>
    <exclude body1="first" body2="camera"/>
  </contact>
  <option timestep="0.002"/>
</mujoco>
)";

class MjcfInto : public testing::Test {
protected:
    MjcfInto() {
        model.robot = chain_of({"first", "second"});
        model.name = "test";
        model.groups = {group_of("first", {}, flat_tree({{{0, 0, 1.0 / 3}, 0.1 + 0.7}, {{1, 2, 3}, 0.5}})),
                        group_of("second", {}, flat_tree({{{0, 0, 0}, 0.25}}))};
        model.ignored_pairs = {{"first", "second", "Adjacent"}, {"first", "not_there", ""}};
        model.into = TextFile{"arm.xml", theirs};
    }

    std::string written(const std::map<std::string, ParameterValue>& parameters = {}) {
        QuietContext context;
        return writer("xml_models", "write.mjcf", parameters)->write(model, context);
    }
    std::string refused() {
        try {
            written();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }

    SphereModel model;
};

/// Returns the text with one part replaced.
std::string with(std::string text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, text.npos) << part;
    return at == text.npos ? text : text.replace(at, part.size(), by);
}

TEST_F(MjcfInto, KeepsEveryByteButTheSpheresAndThePairs) {
    std::string expected = with(
        theirs, R"(<geom size="0.2" pos="1 0 0"/>)",
        R"(<geom type="sphere" mass="0" pos="0 0 0.3333333333333333" size="0.7999999999999999"/>
      <geom type="sphere" mass="0" pos="1 2 3" size="0.5"/>)");
    expected = with(expected, R"(<geom size="0.1"/>)", R"(<geom contype="0" conaffinity="0" size="0.1"/>
        <geom type="sphere" mass="0" pos="0 0 0" size="0.25"/>)");
    expected =
        with(expected, R"(<exclude body1="first" body2="camera"/>)", R"(<exclude body1="first" body2="second"/>)");
    const std::map<std::string, ParameterValue> replace{{"pairs", std::string("replace")}};
    EXPECT_EQ(written(replace), expected) << "a body without <inertial> keeps the geoms that it has its mass from";
    model.into->text = expected;
    EXPECT_EQ(written(replace), expected) << "the second time nothing changes";
}

TEST_F(MjcfInto, ReplacesOtherCollisionGeomsOnRequestAndKeepsTheirClass) {
    const std::string text = written({{"collision", true}});
    EXPECT_THAT(text, HasSubstr(R"(
      <geom class="visual" size="0.5"/>
      <geom class="hull" type="sphere" mass="0" pos="0 0 0.3333333333333333" size="0.7999999999999999"/>
      <geom class="hull" type="sphere" mass="0" pos="1 2 3" size="0.5"/>
      <!-- between -->
      <body name="second">)"));
    EXPECT_THAT(text, HasSubstr(R"(<exclude body1="first" body2="camera"/>)"));
    auto read = read_spheres(*writer("xml_models", "write.mjcf"), text);
    EXPECT_EQ(read["first"], model.groups[0].tree.finest());
    EXPECT_EQ(read["camera"].size(), 1u) << "no link of the model: as it was";
}

TEST_F(MjcfInto, AddsPairsWhereThereAreNone) {
    model.into->text = R"(<mujoco><worldbody><body name="first"/><body name="second"/></worldbody></mujoco>)";
    EXPECT_THAT(written({{"pairs", std::string("merge")}}),
                HasSubstr(R"(</worldbody><contact><exclude body1="first" body2="second"/></contact></mujoco>)"));
}

TEST_F(MjcfInto, RefusesAnotherFileAndAMissingBody) {
    model.into->text = "<robot name=\"arm\"></robot>";
    EXPECT_EQ(refused(), "arm.xml:1: <robot> is not the <mujoco> of an MJCF file");
    model.into->text = "<mujoco><worldbody><body name=\"frist\"/></worldbody></mujoco>";
    EXPECT_EQ(refused(), "arm.xml: there is no body 'first' for the link of that name (there is 'frist'); remedy: "
                         "rename the body, or leave the link out");
}

/// Every place of an MJCF file that names a geom.
constexpr const char* naming = R"(<mujoco>
  <worldbody><geom name="seen" type="plane" size="1 1 1"/>
    <body name="first"><geom name="palm" size="0.1"/></body>
    <body name="second"><geom name="foot" size="0.2"/><geom size="0.1"/>
      <site name="s"/></body>
  </worldbody>
  <contact><pair geom1="seen" geom2="seen"/></contact>
  {}
</mujoco>
)";

std::string naming_by(const std::string& element) {
    return with(naming, "{}", element);
}

TEST_F(MjcfInto, APairHoldsForEachGeomThatReplacesOneOfIt) {
    model.into->text = naming_by(R"(<contact>
    <pair name="p" geom1="palm" geom2="foot" condim="1"/>
    <pair geom1="seen" geom2="palm"/></contact>)");
    const std::string text = written();
    EXPECT_THAT(text, HasSubstr(R"(<geom name="palm_1" type="sphere" mass="0")"));
    EXPECT_THAT(text, HasSubstr(R"(<geom name="palm_2" type="sphere" mass="0")"));
    EXPECT_THAT(text, HasSubstr(R"(<geom name="foot_1" type="sphere" mass="0")"));
    EXPECT_THAT(text, HasSubstr(R"(<contact>
    <pair name="p" geom1="palm_1" geom2="foot_1" condim="1"/>
    <pair geom1="palm_2" geom2="foot_1" condim="1"/>
    <pair geom1="seen" geom2="palm_1"/>
    <pair geom1="seen" geom2="palm_2"/></contact>)"));
    model.into->text = text;
    EXPECT_EQ(written(), text) << "the second time nothing changes";
}

TEST_F(MjcfInto, APairOfAGeomThatGoesWithoutAnotherGoes) {
    auto robot = std::make_shared<Robot>(*model.robot);
    robot->file = "/robots/arm.xml";
    robot->source = naming_by(R"(<contact><pair geom1="seen" geom2="foot"/></contact>)");
    model.robot = robot;
    model.into.reset();
    model.groups.pop_back();
    model.without_collision = {"second"};
    const std::string text = written();
    EXPECT_THAT(text, Not(HasSubstr("geom2=\"foot\"")));
    EXPECT_THAT(text, HasSubstr(R"(<pair geom1="seen" geom2="seen"/>)"));
}

TEST_F(MjcfInto, NewNamesAreNotThoseOfOtherGeoms) {
    model.into->text =
        with(naming_by(R"(<contact><pair geom1="seen" geom2="palm"/></contact>)"), "\"seen\" type", "\"palm_1\" type");
    EXPECT_THAT(written(), HasSubstr(R"(<pair geom1="seen" geom2="palm_2"/><pair geom1="seen" geom2="palm_3"/>)"));
}

TEST_F(MjcfInto, ASensorOfTheContactsOfAReplacedGeomIsRefused) {
    model.into->text = naming_by(R"(<sensor><contact geom1="foot" body2="first"/></sensor>)");
    EXPECT_EQ(refused(), R"(arm.xml:8: <contact geom1="foot"> senses the contacts of a geom that others replace; remedy: )"
                         R"(let it name the body, by body1, skip the link, or allow one element for it)")
        << "one replaces two";
}

TEST_F(MjcfInto, AGeomThatOthersNameStaysWithoutContact) {
    for (const char* element :
         {R"(<sensor><framepos objtype="geom" objname="palm"/></sensor>)",
          R"(<sensor><framepos objtype="site" objname="s" reftype="geom" refname="palm"/></sensor>)",
          R"(<sensor><distance geom1="palm" body2="second"/></sensor>)",
          R"(<tendon><spatial><site site="s"/><geom geom="palm"/><site site="s"/></spatial></tendon>)",
          R"(<custom><tuple name="t"><element objtype="geom" objname="palm"/></tuple></custom>)"}) {
        model.into->text = with(naming_by(element), R"(<body name="first">)",
                                R"(<body name="first"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)");
        EXPECT_THAT(written(), HasSubstr(R"(<geom contype="0" conaffinity="0" name="palm" size="0.1"/>)")) << element;
    }
}

TEST_F(MjcfInto, OtherObjectsMayHaveTheNameOfAReplacedGeom) {
    model.into->text = naming_by(R"(<sensor><framepos objtype="body" objname="foot"/><touch site="foot"/></sensor>)");
    EXPECT_THAT(written(), HasSubstr(R"(<framepos objtype="body" objname="foot"/><touch site="foot"/>)"));
}

TEST_F(MjcfInto, OneThatReplacesOneKeepsItsName) {
    model.into->text = with(theirs, R"(<geom size="0.1"/>)", R"(<geom name="foot" size="0.1"/>)");
    model.into->text = with(model.into->text, "geom2=\"floor\"", "geom2=\"foot\"");
    const std::string text = written();
    EXPECT_THAT(text, HasSubstr(R"(<geom contype="0" conaffinity="0" size="0.1"/>
        <geom name="foot" type="sphere" mass="0" pos="0 0 0" size="0.25"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<pair geom1="floor" geom2="foot"/>)"));
    model.into->text = text;
    EXPECT_EQ(written(), text) << "the second time nothing changes";
}

TEST_F(MjcfInto, NewGeomsTakeTheSettingsOfContact) {
    model.into->text = with(theirs, R"(<geom size="0.2" pos="1 0 0"/>)",
                            R"(<geom size="0.2" pos="1 0 0" friction="0.2 0.1 0.1" condim="6" solref="0.01 1" group="4" )"
                            R"(rgba="1 0 0 1" contype="2" conaffinity="4"/>)");
    EXPECT_THAT(written(), HasSubstr(R"(<geom type="sphere" contype="2" conaffinity="4" condim="6" group="4" )"
                                     R"(friction="0.2 0.1 0.1" solref="0.01 1" rgba="1 0 0 1" mass="0" pos="1 2 3")"));
}

TEST_F(MjcfInto, GeomsInFramesAndCopiesAreReplaced) {
    model.into->text = R"(<mujoco>
  <default><default class="c"><geom friction="0.1"/></default></default>
  <worldbody>
    <body name="first">
      <inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
      <frame pos="1 0 0" childclass="c">
        <geom size="0.2"/>
      </frame>
      <replicate count="3" offset="1 0 0">
        <geom size="0.3"/>
      </replicate>
    </body>
    <frame pos="0 0 1"><body name="second"/></frame>
  </worldbody>
</mujoco>
)";
    const std::string text = written();
    EXPECT_THAT(text, HasSubstr(R"(
      <frame pos="1 0 0" childclass="c">
      </frame>
      <replicate count="3" offset="1 0 0">
      </replicate>
      <geom class="c" type="sphere" mass="0")"));
    auto read = read_spheres(*writer("xml_models", "write.mjcf"), text);
    EXPECT_EQ(read["first"], model.groups[0].tree.finest());
    EXPECT_EQ(read["second"], model.groups[1].tree.finest());
}

TEST_F(MjcfInto, TheRobotsOwnTextIsEditedWithoutInto) {
    auto robot = std::make_shared<Robot>(*model.robot);
    robot->file = "/robots/arm.xml";
    robot->source = with(theirs, R"(<default>)", R"(<asset><mesh name="a" file="a.obj"/></asset><default>)");
    model.robot = robot;
    model.into.reset();
    EXPECT_THAT(written(), HasSubstr(R"(<exclude body1="first" body2="camera"/>)"));
    EXPECT_THAT(written(), Not(HasSubstr("<geom class=\"hull\" mesh=")));
    EXPECT_THAT(written(), Not(HasSubstr("<compiler")));
    model.folder = "/robots/out";
    EXPECT_THAT(written(), HasSubstr(R"(<compiler meshdir=".."/>)"));
    model.without_collision = {"camera"};
    EXPECT_THAT(written(), HasSubstr(R"(<body name="camera"><geom contype="0" conaffinity="0" size="0.03"/></body>)"));
}

TEST_F(MjcfInto, PathsLeadFromTheFolderOfTheOutput) {
    model.into = TextFile{"/robots/arm.xml", with(theirs, R"(<default>)", R"(<asset><mesh name="a" file="a.obj"/></asset><default>)")};
    model.folder = "/robots";
    EXPECT_THAT(written(), Not(HasSubstr("<compiler")));
    model.folder = "/robots/out";
    EXPECT_THAT(written(), HasSubstr(R"(<compiler meshdir=".."/>)"));
    model.into->text = with(theirs, R"(<default>)", R"(<asset><texture type="skybox" fileup="sky.png"/></asset><default>)");
    EXPECT_THAT(written(), HasSubstr(R"(<compiler texturedir=".."/>)"));
}

TEST_F(MjcfInto, IncludedFilesWithGeomsAreMerged) {
    const TemporaryFolder folder;
    const auto file = [&](const char* name, const char* text) { std::ofstream(folder.path() / name) << text; };
    file("arms.xml", R"(<mujoco><body name="first"><geom size="0.2" mass="0"/></body><body name="second"/></mujoco>)");
    file("look.xml", R"(<mujoco><asset/></mujoco>)");
    file("seen.xml", R"(<mujoco><sensor><framepos objtype="geom" objname="g"/></sensor></mujoco>)");
    model.into = TextFile{folder.path() / "main.xml",
                          R"(<mujoco><include file="look.xml"/><worldbody><include file="arms.xml"/></worldbody></mujoco>)"};
    const std::string text = written();
    EXPECT_THAT(text, HasSubstr(R"(<mujoco><include file="look.xml"/><worldbody><body name="first"><geom type="sphere")"));
    EXPECT_THAT(text, HasSubstr(R"(</body></worldbody></mujoco>)"));
    model.into->text = R"(<mujoco><include file="seen.xml"/></mujoco>)";
    EXPECT_THAT(refused(), HasSubstr("there is no body 'first'"));
    model.into->text = R"(<mujoco><worldbody><include file="none.xml"/></worldbody></mujoco>)";
    EXPECT_THAT(refused(), HasSubstr("main.xml:1: the file 'none.xml' that is included is not found"));
}

} // namespace
} // namespace foam::test
