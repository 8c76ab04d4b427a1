// write.mjcf with `into`: the user's own file keeps every byte but the spheres, and the pairs on request.
#include "models.hpp"
#include "support/read_spheres.hpp"

#include <foam/sdk/stage.hpp>

#include <gmock/gmock.h>

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
        R"(<geom type="sphere" group="3" contype="1" conaffinity="1" mass="0" pos="0 0 0.3333333333333333" size="0.7999999999999999"/>
      <geom type="sphere" group="3" contype="1" conaffinity="1" mass="0" pos="1 2 3" size="0.5"/>)");
    expected = with(expected, R"(<geom size="0.1"/>)",
                    R"(<geom type="sphere" group="3" contype="1" conaffinity="1" pos="0 0 0" size="0.25"/>)");
    expected =
        with(expected, R"(<exclude body1="first" body2="camera"/>)", R"(<exclude body1="first" body2="second"/>)");
    const std::map<std::string, ParameterValue> replace{{"pairs", std::string("replace")}};
    EXPECT_EQ(written(replace), expected) << "a body without <inertial> gets its mass from its geoms";
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
  <worldbody>
    <body name="first"><geom name="palm" size="0.1"/></body>
    <body name="second"><geom name="foot" size="0.2"/><geom size="0.1"/><geom name="seen" size="1" contype="0" conaffinity="0"/>
      <site name="s"/></body>
  </worldbody>
  <contact><pair geom1="seen" geom2="seen"/></contact>
  {}
</mujoco>
)";

std::string naming_by(const std::string& element) {
    return with(naming, "{}", element);
}

TEST_F(MjcfInto, AnElementThatNamesAReplacedGeomIsRefused) {
    const auto refusal = [](const std::string& names, const std::string& element) {
        return "arm.xml:8: " + names + " names a geom that is replaced by others without names, so MuJoCo would refuse " +
               "the file; remedy: remove <" + element + R"(>, or keep the geom by contype="0" conaffinity="0")";
    };
    model.into->text = naming_by(R"(<contact><pair geom1="seen" geom2="foot"/></contact>)");
    EXPECT_EQ(refused(), refusal(R"(<pair geom2="foot">)", "pair"));
    model.into->text = naming_by(R"(<contact><pair geom1="palm" geom2="seen"/></contact>)");
    EXPECT_EQ(refused(), refusal(R"(<pair geom1="palm">)", "pair"));
    model.into->text = naming_by(R"(<sensor><distance geom1="foot" body2="first"/></sensor>)");
    EXPECT_EQ(refused(), refusal(R"(<distance geom1="foot">)", "distance")) << "one replaces two";
    model.into->text = naming_by(R"(<sensor><framepos objtype="geom" objname="foot"/></sensor>)");
    EXPECT_EQ(refused(), refusal(R"(<framepos objname="foot">)", "framepos"));
    model.into->text =
        naming_by(R"(<sensor><framepos objtype="site" objname="s" reftype="geom" refname="foot"/></sensor>)");
    EXPECT_EQ(refused(), refusal(R"(<framepos refname="foot">)", "framepos"));
    model.into->text =
        naming_by(R"(<tendon><spatial><site site="s"/><geom geom="foot"/><site site="s"/></spatial></tendon>)");
    EXPECT_EQ(refused(), refusal(R"(<geom geom="foot">)", "geom"));
    model.into->text =
        naming_by(R"(<custom><tuple name="t"><element objtype="geom" objname="foot"/></tuple></custom>)");
    EXPECT_EQ(refused(), refusal(R"(<element objname="foot">)", "element"));
}

TEST_F(MjcfInto, TheOtherLinesThatNameReplacedGeomsAreListed) {
    model.into->text = naming_by("<contact><pair geom1=\"foot\" geom2=\"palm\"/>\n<pair geom1=\"seen\" geom2=\"foot\"/>\n"
                                 "<pair geom1=\"palm\" geom2=\"seen\"/></contact>");
    EXPECT_EQ(refused(), R"(arm.xml:8: <pair geom1="foot"> names a geom that is replaced by others without names, so )"
                         R"(MuJoCo would refuse the file (so do lines 9, 10); remedy: remove <pair>, or keep the geom )"
                         R"(by contype="0" conaffinity="0")");
}

TEST_F(MjcfInto, OtherObjectsMayHaveTheNameOfAReplacedGeom) {
    model.into->text = naming_by(R"(<sensor><framepos objtype="body" objname="foot"/><touch site="foot"/></sensor>)");
    EXPECT_THAT(written(), HasSubstr(R"(<framepos objtype="body" objname="foot"/><touch site="foot"/>)"));
}

TEST_F(MjcfInto, OneThatReplacesOneKeepsItsName) {
    model.into->text = with(theirs, R"(<geom size="0.1"/>)", R"(<geom name="foot" size="0.1"/>)");
    model.into->text = with(model.into->text, "geom2=\"floor\"", "geom2=\"foot\"");
    const std::string text = written();
    EXPECT_THAT(text, HasSubstr(R"(<geom name="foot" type="sphere" group="3" contype="1" conaffinity="1" pos="0 0 0" size="0.25"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<pair geom1="floor" geom2="foot"/>)"));
    model.into->text = text;
    EXPECT_EQ(written(), text) << "the second time nothing changes";
}

TEST_F(MjcfInto, IncludedFilesAreNotSearchedForTheNamesOfReplacedGeoms) {
    class Warnings final : public QuietContext {
    public:
        void log(Severity, std::string_view message) override { all.emplace_back(message); }
        std::vector<std::string> all;
    } context;
    model.into->text = naming_by(R"(<include file="sensors.xml"/>)");
    writer("xml_models", "write.mjcf")->write(model, context);
    EXPECT_THAT(context.all, testing::Contains("arm.xml:8: the file that is included may name geoms that are replaced by "
                                               "others without names: foot, palm; remedy: remove what names them"));
}

} // namespace
} // namespace foam::test
