// write.vamp: what cricket and VAMP require, each requirement a test (the contract: CoMMALab/cricket a2ad9d6db7 and
// 0a1eff2513, src/fkcc_gen.cc and src/robot_info.cc).
#include "models.hpp"
#include "support/shared_folder.hpp"
#include "support/read_spheres.hpp"

#include <foam/robot/kinematics.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <urdf_parser/urdf_parser.h>

#include <fstream>
#include <numbers>

namespace foam::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const char* const gripper = R"(<robot name="gripper-2">
  <link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
  <link name="arm"><collision><geometry><sphere radius="1"/></geometry></collision></link>
  <link name="wheel"/> <link name="drifter"/> <link name="sheet"/> <link name="left"/> <link name="right"/>
  <joint name="lift" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="0.10 +0.2 .3" rpy="0.4 1.5707963267948966 -2"/>
    <axis xyz="0 0.6 0.8"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="roll" type="continuous"><parent link="arm"/><child link="wheel"/><axis xyz="0 0 1"/></joint>
  <joint name="drift" type="floating"><parent link="wheel"/><child link="drifter"/><origin xyz="0 0 1"/></joint>
  <joint name="slide" type="planar"><parent link="wheel"/><child link="sheet"/><axis xyz="0 0 1"/></joint>
  <joint name="finger" type="prismatic"><parent link="wheel"/><child link="left"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="other_finger" type="prismatic"><parent link="wheel"/><child link="right"/><axis xyz="0 1 0"/>
    <origin rpy="0 0 0.5"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/>
    <mimic joint="finger" multiplier="-2" offset="0.01"/></joint>
</robot>
)";

class WriteVamp : public testing::Test {
protected:
    WriteVamp() {
        for (const char* plugin : {"write_urdf", "xml_models", "load_urdf"}) {
            EXPECT_TRUE(registry_.load(std::string(FOAM_TEST_PLUGINS "/") + plugin + ".so").loaded()) << plugin;
        }
        model_.robot = robot_of(gripper);
        model_.name = "test";
        model_.file = "gripper_vamp.urdf";
        model_.folder = "/somewhere";
        model_.facts.lock_joints = {{"finger", 0.03}};
        model_.facts.tool_frames = {"wheel"};
        model_.groups = {group_of("base", {}, flat_tree({{{0, 0, 0}, 0.9}, {{2.25, 0, 0}, 0.5}, {{0.1, 0, 0}, 0.7}})),
                         group_of("arm", {}, flat_tree({{{0, 0, 1.0 / 3}, 0.1 + 0.7}}))};
        model_.ignored_pairs = {{"base", "arm", "Adjacent"}, {"base", "wheel", ""}};
    }

    std::shared_ptr<const Robot> robot_of(const std::string& text) const {
        QuietContext context;
        return std::make_shared<Robot>(
            registry_.make<RobotLoader>("load.urdf")->load(text, "/none/gripper.urdf", ResourceResolver(), context));
    }
    std::unique_ptr<Writer> vamp(const std::map<std::string, ParameterValue>& parameters = {}) const {
        return registry_.make<Writer>("write.vamp", parameters);
    }
    std::shared_ptr<const Robot> written() {
        QuietContext context;
        text_ = vamp()->write(model_, context);
        return robot_of(text_);
    }
    std::string srdf() const {
        QuietContext context;
        return vamp()->companion("srdf", model_, context);
    }
    Json job(const std::map<std::string, ParameterValue>& parameters = {}) const {
        QuietContext context;
        return Json::parse(vamp(parameters)->companion("json", model_, context));
    }
    static const Joint& joint(const Robot& robot, const std::string& name) {
        return *std::find_if(robot.joints.begin(), robot.joints.end(), [&](const Joint& j) { return j.name == name; });
    }

    Registry registry_;
    SphereModel model_;
    std::string text_;
};

TEST_F(WriteVamp, EveryCollisionIsASphere) { // 1
    const auto robot = written();
    for (const Link& link : robot->links) {
        for (const GeometryElement& element : link.collisions) {
            const auto* primitive = std::get_if<Element>(&element.geometry);
            EXPECT_TRUE(primitive && primitive->kind == Element::Kind::sphere) << link.name;
        }
    }
    model_.groups.erase(model_.groups.begin());
    EXPECT_EQ(
        refusal(*vamp(), model_),
        "write.vamp: link 'base' has collision geometry, but no spheres (/none/gripper.urdf:2), and cricket reads "
        "spheres only; remedy: a model with spheres for it");
    model_.groups = {group_of("base", {}, flat_tree({{{0, 0, 0}, 0.9}}))};
    EXPECT_EQ(refusal(*vamp(), model_), "") << "the geometry of the other link is a sphere";
}

TEST_F(WriteVamp, LockedJointsAreFixedWhereTheyStand) { // 2
    const auto robot = written();
    for (const char* name : {"finger", "other_finger"}) {
        EXPECT_EQ(joint(*robot, name).kind, Joint::Kind::fixed) << name;
    }
    EXPECT_THAT(text_, Not(HasSubstr("mimic")));
    EXPECT_EQ(text_.find("<limit"), text_.find("<limit lower=\"-1\"")) << "no limit of a joint that is fixed";
    EXPECT_LT(distance(joint(*robot, "finger").origin.translation, {0, 0.03, 0}), 1e-15);
    // -2 · 0.03 + 0.01 along y, which the origin turns.
    EXPECT_LT(
        distance(joint(*robot, "other_finger").origin.translation, Vec3{-std::sin(0.5), std::cos(0.5), 0} * -0.05),
        1e-15);
}

TEST_F(WriteVamp, AllLinksStandWhereTheyStood) { // 2, 3
    for (const double value : {0.0, 1.25, -0.5}) {
        model_.facts.lock_joints["lift"] = value;
        const auto robot = written();
        EXPECT_EQ(Kinematics(robot).freedoms().size(), 1u);
        const auto before =
            link_poses(*model_.robot, {{"lift", value}, {"roll", 2.5}, {"finger", 0.03}, {"other_finger", -0.05}});
        for (const auto& [link, pose] : link_poses(*robot, {{"roll", 2.5}})) {
            EXPECT_LT(distance(pose.translation, before.at(link).translation), 1e-15) << link;
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_LT(distance(pose.rotation[i], before.at(link).rotation[i]), 4e-15) << link << " " << value;
            }
        }
    }
}

TEST_F(WriteVamp, AnOriginThatDoesNotChangeKeepsItsBytes) {
    model_.facts.lock_joints["lift"] = 0;
    written();
    EXPECT_THAT(text_, HasSubstr(R"(  <joint name="lift" type="fixed">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="0.10 +0.2 .3" rpy="0.4 1.5707963267948966 -2"/>
    <axis xyz="0 0.6 0.8"/>
  </joint>
)"));
}

TEST_F(WriteVamp, AJointThatTurnsWithoutEndHasOneTurn) { // 3
    const auto robot = written();
    EXPECT_EQ(joint(*robot, "roll").kind, Joint::Kind::revolute);
    EXPECT_EQ(joint(*robot, "roll").lower, -std::numbers::pi);
    EXPECT_EQ(joint(*robot, "roll").upper, std::numbers::pi);
    EXPECT_THAT(text_, HasSubstr("<limit lower=\"-3.141592653589793\" upper=\"3.141592653589793\" effort=\"0\" "
                                 "velocity=\"0\"/></joint>"));
    std::string limited = gripper;
    const std::string axis = "<child link=\"wheel\"/>";
    limited.insert(limited.find(axis), "<limit effort=\"12\" velocity='7'/>");
    model_.robot = robot_of(limited);
    EXPECT_EQ(joint(*written(), "roll").upper, std::numbers::pi);
    EXPECT_THAT(text_, HasSubstr("effort=\"12\" velocity='7'/>"));
}

TEST_F(WriteVamp, FloatingAndPlanarJointsAreFixed) { // 3
    class Listening final : public QuietContext {
    public:
        void log(Severity, std::string_view message) override { said += message; }
        std::string said;
    } context;
    const auto robot = robot_of(vamp()->write(model_, context));
    EXPECT_EQ(joint(*robot, "drift").kind, Joint::Kind::fixed);
    EXPECT_EQ(joint(*robot, "slide").kind, Joint::Kind::fixed);
    EXPECT_EQ(joint(*robot, "drift").origin.translation, (Vec3{0, 0, 1}));
    EXPECT_THAT(context.said, HasSubstr("fixed where they stand: drift, slide"));
    EXPECT_THAT(context.said, HasSubstr("that of 'base' is the largest for its spheres: ")); // 7
}

TEST_F(WriteVamp, AJointThatMimicsAPlannedOneIsRefused) { // 2
    model_.facts.lock_joints.clear();
    EXPECT_EQ(refusal(*vamp(), model_),
              "write.vamp: joint 'other_finger' mimics 'finger', and cricket would plan each of them; remedy: hold "
              "them: --lock finger=VALUE, or robot: {lock_joints: {finger: VALUE}} in the recipe");
    model_.facts.lock_joints = {{"finger", 0}, {"lift", 0}, {"roll", 0}};
    EXPECT_THAT(refusal(*vamp(), model_), HasSubstr("needs a joint that moves and is not locked"));
    model_.facts.lock_joints = {{"drift", 0}};
    EXPECT_THAT(refusal(*vamp(), model_), HasSubstr("drift"));
}

TEST_F(WriteVamp, TheNameIsThatOfACppStruct) { // 4
    EXPECT_EQ(job()["name"], "Gripper_2");
    EXPECT_EQ(job()["output"], "gripper_2_fk.hh");
    EXPECT_EQ(job({{"name", "UR10e"}})["name"], "UR10e");
    EXPECT_EQ(job({{"name", "UR10e"}})["output"], "ur10e_fk.hh");
    for (const auto& [name, remedy] : {std::pair("ur-5", "Ur_5"), std::pair("5dof", "Robot_5dof"),
                                       std::pair("a b", "A_b"), std::pair("\xC3\xA9", "__")}) {
        try {
            vamp({{"name", name}});
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_THAT(error.what(), HasSubstr("cannot be the name of a C++ struct"));
            EXPECT_THAT(error.what(), HasSubstr(": " + std::string(remedy)));
        }
    }
}

TEST_F(WriteVamp, ThereIsAlwaysAnSrdf) { // 5
    EXPECT_THAT(srdf(), HasSubstr("<robot name=\"gripper-2\">\n"
                                  "  <disable_collisions link1=\"base\" link2=\"arm\" reason=\"Adjacent\"/>\n"
                                  "  <disable_collisions link1=\"base\" link2=\"wheel\" reason=\"User\"/>\n"));
    EXPECT_EQ(job()["srdf"], "gripper_vamp.srdf") << "Pinocchio requires the ending";
    QuietContext context;
    const auto alone = writer("write_urdf", "write.vamp");
    EXPECT_THROW(alone->companion("srdf", model_, context), Error) << "no plugin has write.srdf";
}

TEST_F(WriteVamp, AnnotatesWhereTheUrdfIsFrom) {
    model_.provenance = "foam 1; arm--\xC3\xA9.urdf\n";
    written();
    EXPECT_THAT(text_, testing::StartsWith("<!-- foam 1; arm- -??.urdf? -->\n<robot name=\"gripper-2\">\n"));
}

TEST_F(WriteVamp, SpheresKeepTheirOrder) { // 6
    QuietContext context;
    EXPECT_EQ(read_spheres(*vamp(), vamp()->write(model_, context)), spheres_of(model_));
}

TEST_F(WriteVamp, UrdfdomReadsIt) { // Pinocchio's parser
    written();
    const auto robot = urdf::parseURDF(text_);
    ASSERT_TRUE(robot);
    std::vector<std::string> planned;
    for (const auto& [name, joint] : robot->joints_) {
        EXPECT_TRUE(joint->type == urdf::Joint::FIXED || joint->type == urdf::Joint::REVOLUTE) << name;
        EXPECT_FALSE(joint->mimic) << name;
        if (joint->type != urdf::Joint::FIXED) {
            planned.push_back(name);
        }
    }
    EXPECT_THAT(planned, ElementsAre("lift", "roll"));
    EXPECT_EQ(robot->getJoint("roll")->limits->upper, std::numbers::pi);
    for (const auto& [link, spheres] : spheres_of(model_)) {
        const auto& read = robot->getLink(link)->collision_array;
        ASSERT_EQ(read.size(), spheres.size());
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            const auto* sphere = dynamic_cast<const urdf::Sphere*>(read[i]->geometry.get());
            ASSERT_TRUE(sphere) << link;
            const auto& at = read[i]->origin.position;
            EXPECT_EQ((Sphere{{at.x, at.y, at.z}, sphere->radius}), spheres[i]);
        }
    }
}

TEST_F(WriteVamp, TheProofIsAlsoMadeInSinglePrecision) { // 8
    EXPECT_TRUE(registry_.find("write.vamp")->info.consumer.float32);
}

TEST_F(WriteVamp, TheJobHasTheKeysOfCricketAndNoNull) {
    EXPECT_EQ(job().dump(), R"({"name":"Gripper_2","urdf":"gripper_vamp.urdf","srdf":"gripper_vamp.srdf",)"
                            R"("end_effector":"wheel","resolution":32,"template":"templates/fk_template.hh",)"
                            R"("subtemplates":[{"name":"ccfk","template":"templates/ccfk_template.hh"}],)"
                            R"("output":"gripper_2_fk.hh"})");
    model_.facts.tool_frames.clear();
    const Json rust = job({{"language", "rust"}, {"templates", "/opt/cricket"}, {"resolution", std::int64_t{64}}});
    EXPECT_FALSE(rust.contains("end_effector"));
    EXPECT_EQ(rust["template"], "/opt/cricket/fk_template.rs");
    EXPECT_EQ(rust["language"], "rust");
    EXPECT_TRUE(rust["resolution"].is_number_integer());
    model_.facts.tool_frames = {"wheel", "arm"};
    EXPECT_EQ(job()["end_effector"], Json({"wheel", "arm"}));
    model_.facts.tool_frames = {"whel"};
    QuietContext context;
    EXPECT_THROW(vamp()->companion("json", model_, context), Error);
}

TEST_F(WriteVamp, TheirOwnJobHasTheSameKeysAndTypes) {
    const auto file = shared_folder() / "reference_formats/cricket/panda.json";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const Json theirs = Json::parse(std::ifstream(file)), ours = job();
    ASSERT_EQ(ours.size(), theirs.size());
    for (const auto& [key, value] : theirs.items()) {
        ASSERT_TRUE(ours.contains(key)) << key;
        EXPECT_EQ(ours[key].type(), value.type()) << key;
    }
    EXPECT_EQ(ours["template"], theirs["template"]);
    EXPECT_EQ(ours["subtemplates"], theirs["subtemplates"]);
}

} // namespace
} // namespace foam::test
