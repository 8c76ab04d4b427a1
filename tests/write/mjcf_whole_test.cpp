// write.mjcf for a robot that was read from a URDF: what the URDF states of joints and looks, and actuators.
#include "models.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/file.hpp>
#include <foam/sdk/stage.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace {

using namespace foam;
using namespace foam::test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Keeps the warnings of a stage.
class WarningContext final : public QuietContext {
public:
    void log(Severity severity, std::string_view message) override {
        if (severity == Severity::warning) {
            warnings.emplace_back(message);
        }
    }
    std::vector<std::string> warnings;
};

constexpr const char* mass =
    R"(<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>)";

/// A base that carries a tip by one joint. `joint`: kind and content of the joint; `looks`: visuals of the tip.
std::string two_links(const std::string& kind, const std::string& joint, const std::string& looks = "") {
    return "<robot name=\"two\">\n<link name=\"base\"/>\n<link name=\"tip\">" + std::string(mass) + looks +
           "</link>\n<joint name=\"j\" type=\"" + kind + "\"><parent link=\"base\"/><child link=\"tip\"/>" + joint +
           "</joint></robot>";
}

struct Written {
    std::string text;
    std::map<std::string, std::string> beside;
    std::vector<std::string> warnings;
};

/// Writes a robot with a sphere on its tip. `folder`: of the URDF and the output; empty: the place is not known.
Written written(const std::string& urdf, const std::map<std::string, ParameterValue>& parameters = {},
                const std::filesystem::path& folder = {}) {
    Registry registry;
    for (const char* plugin : {"load_urdf", "load_mesh", "xml_models"}) {
        registry.load(std::string(FOAM_TEST_PLUGINS "/") + plugin + ".so");
    }
    QuietContext quiet;
    const std::filesystem::path file = (folder.empty() ? "/none" : folder) / "two.urdf";
    SphereModel model = model_of(std::make_shared<Robot>(registry.make<RobotLoader>("load.urdf")->load(
                                     urdf, file, ResourceResolver::from_environment(), quiet)),
                                 {group_of("tip", {}, flat_tree({{{0, 0, 0}, 0.1}}))});
    model.folder = folder;
    model.file = "two.xml";
    WarningContext context;
    const auto writer = registry.make<Writer>("write.mjcf", parameters);
    const std::string text = writer->write(model, context);
    const auto beside = writer->files_beside(model, quiet);
    EXPECT_EQ(writer->read(text, beside).at("tip").spheres().size(), 1U) << "visuals are no elements";
    return {text, beside, context.warnings};
}

TEST(MjcfWhole, JointsKeepTheirLimitsAndLosses) {
    const Written all = written(two_links("revolute", R"(<axis xyz="0 1 0"/>
        <limit lower="-1" upper="2" effort="7" velocity="3"/><dynamics damping="0.5" friction="0.25"/>)"));
    EXPECT_THAT(all.text, HasSubstr(R"(<joint name="j" axis="0 1 0" range="-1 2" actuatorfrcrange="-7 7" )"
                                    R"(damping="0.5" frictionloss="0.25"/>)"));
    EXPECT_THAT(all.warnings, ElementsAre());
    const Written none = written(two_links("revolute", R"(<limit lower="0" upper="0" effort="0" velocity="0"/>
        <dynamics damping="0"/>)"));
    EXPECT_THAT(none.text, HasSubstr(R"(<joint name="j" axis="1 0 0"/>)")) << "0 is no limit, as for MuJoCo";
}

TEST(MjcfWhole, ANegativeLossIsNamedAndLeftOut) {
    const Written result = written(two_links("continuous", R"(<dynamics damping="-0.5" friction="1"/>)"));
    EXPECT_THAT(result.text, HasSubstr(R"(axis="1 0 0" frictionloss="1"/>)"));
    EXPECT_THAT(result.warnings, ElementsAre("joint 'j' has a negative damping, -0.5, which feeds it with energy: left "
                                             "out; remedy: a number that is not negative"));
}

TEST(MjcfWhole, VisualPrimitivesAreSeenAndElementsAreBehindThem) {
    const std::string looks = R"(<visual><origin xyz="0 0 1"/><geometry><box size="2 4 6"/></geometry>
        <material name=""><color rgba="1 0.5 0 2"/></material></visual>)";
    const std::string text = written(two_links("fixed", "", looks)).text;
    EXPECT_THAT(text, HasSubstr(R"(<default class="visual"><geom group="2" mass="0" contype="0" conaffinity="0"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<geom class="visual" type="box" size="1 2 3" pos="0 0 1" rgba="1 0.5 0 1"/>)"));
    EXPECT_THAT(text, HasSubstr(R"(<geom class="sphere" pos="0 0 0" size="0.1"/>)")) << "of group 3, by its class";
    EXPECT_THAT(written(two_links("fixed", "")).text, HasSubstr(R"(<geom class="sphere" group="0" pos=)"))
        << "nothing else is to be seen";
    EXPECT_THAT(written(two_links("fixed", "", looks), {{"visuals", false}}).text,
                HasSubstr(R"(<geom class="sphere" group="0" pos=)"));
}

std::string mesh(const std::string& file) {
    return "<visual><geometry><mesh filename=\"" + file + "\"/></geometry></visual>";
}

TEST(MjcfWhole, MeshesAreNamedFromTheOutput) {
    const TemporaryFolder folder;
    const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::filesystem::create_directory(folder.path() / "meshes");
    std::ofstream(folder.path() / "meshes" / "part.obj") << text;
    const Written result = written(two_links("fixed", "", mesh("meshes/part.obj") + mesh("meshes/part.obj")), {},
                                   folder.path());
    EXPECT_THAT(result.text, HasSubstr(R"(<asset>
    <mesh class="visual" name="part" file="meshes/part.obj"/>
  </asset>)"));
    EXPECT_THAT(result.text, HasSubstr(R"(<geom class="visual" type="mesh" mesh="part"/>)"));
    EXPECT_TRUE(result.beside.empty());
}

TEST(MjcfWhole, MeshesThatMuJoCoDoesNotReadBecomeObj) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "part.off")
        << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    std::ofstream(folder.path() / "flat.off") << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 2 1\n";
    std::ofstream(folder.path() / "bad.off") << "OFF\n4 4 0\n0 0\n";
    const Written result = written(two_links("fixed", "", mesh("part.off") + mesh("flat.off") + mesh("bad.off")), {},
                                   folder.path());
    EXPECT_THAT(result.text, HasSubstr(R"(name="part" file="two_visuals/part.obj"/>)"));
    ASSERT_EQ(result.beside.size(), 1U);
    EXPECT_THAT(result.beside.at("two_visuals/part.obj"), HasSubstr("v 0 0 0\nv 0 1 0\nv 1 0 0\nv 0 0 1\n"));
    ASSERT_EQ(result.warnings.size(), 2U);
    EXPECT_THAT(result.warnings[0], HasSubstr("visual geometry is left out of tip: "));
    EXPECT_THAT(result.warnings[0] + result.warnings[1], HasSubstr("less than four corners"));
    EXPECT_THAT(result.warnings[0] + result.warnings[1], HasSubstr("bad.off"));
}

TEST(MjcfWhole, MeshesAreLeftOutWhereThePlaceOfTheOutputIsNotKnown) {
    const Written result = written(two_links("fixed", "", mesh("/some/part.obj")));
    EXPECT_THAT(result.text, Not(HasSubstr("part")));
    EXPECT_THAT(result.warnings, ElementsAre("visual geometry is left out of tip: meshes are files beside the MJCF, "
                                             "whose place is not known; remedy: -o FILE"));
}

std::string actuators(const std::string& kind, const std::string& joint, std::vector<std::string>* warnings = nullptr) {
    const Written result = written(two_links("revolute", joint), {{"actuators", kind}});
    if (warnings) {
        *warnings = result.warnings;
    }
    const std::size_t begin = result.text.find("  <actuator>");
    return begin == std::string::npos ? "" : result.text.substr(begin, result.text.find("</mujoco>") - begin);
}

TEST(MjcfWhole, ActuatorsOnDemand) {
    const std::string joint = R"(<limit lower="-1" upper="4" effort="10" velocity="2"/>)";
    EXPECT_EQ(actuators("none", joint), "");
    EXPECT_THAT(actuators("position", joint), HasSubstr(R"(<position name="j" joint="j" kp="100" dampratio="1" )"
                                                        R"(ctrlrange="-1 4" forcerange="-10 10"/>)"));
    EXPECT_THAT(actuators("velocity", joint),
                HasSubstr(R"(<velocity name="j" joint="j" kv="5" ctrlrange="-2 2" forcerange="-10 10"/>)"));
    EXPECT_THAT(actuators("motor", joint), HasSubstr(R"(<motor name="j" joint="j" ctrlrange="-10 10"/>)"));
    std::vector<std::string> warnings;
    EXPECT_THAT(actuators("position", "", &warnings), HasSubstr(R"(kp="100" dampratio="1"/>)"));
    EXPECT_THAT(warnings, ElementsAre("the gain of the actuators of j is a guess: the robot states no effort; remedy: "
                                      "<limit effort=\"…\" velocity=\"…\"/>"));
}

} // namespace
