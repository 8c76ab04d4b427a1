// kind: throughput. The scene, what is refused, and a gripper that lifts a box where MuJoCo is there.
#include "bench/src/grasp_scene.hpp"
#include "bench/src/table.hpp"
#include "experiments.hpp"

#include <foam/base/error.hpp>
#include <foam/sdk/sdk.hpp>

namespace foam::experiment {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* gripper = R"(<robot name="gripper">
  <link name="base"/>
  <link name="palm"><collision><geometry><box size="0.02 0.02 0.02"/></geometry></collision></link>
  <link name="left"><collision><origin xyz="0 0.01 0"/><geometry><box size="0.03 0.02 0.04"/></geometry></collision></link>
  <link name="right"><collision><origin xyz="0 -0.01 0"/><geometry><box size="0.03 0.02 0.04"/></geometry></collision></link>
  <joint name="up" type="prismatic"><parent link="base"/><child link="palm"/><origin xyz="0.5 0 0.3"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.3" effort="1" velocity="1"/></joint>
  <joint name="open" type="prismatic"><parent link="palm"/><child link="left"/><origin xyz="0 0 -0.24"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.06" effort="1" velocity="1"/></joint>
  <joint name="open_too" type="prismatic"><parent link="palm"/><child link="right"/><origin xyz="0 0 -0.24"/>
    <axis xyz="0 -1 0"/><mimic joint="open"/><limit lower="0" upper="0.06" effort="1" velocity="1"/></joint>
</robot>)";

const std::string head = "foam_experiment: 1\nname: x\nkind: throughput\n";
const std::string whole = head + "robot: gripper.urdf\nspheres: [3]\nmethod: spherize.grid\nfingers: [left, right]\n"
                                 "simulations: 2\nrepeats: 2\nthreads: 1\n"
                                 "motion: [{time: 0, joints: {open: 0.06}}, {time: 0.5, joints: {open: 0}}, "
                                 "{time: 1, joints: {up: 0.1}}]\n";

class ThroughputTest : public ExperimentTest {
protected:
    void SetUp() override {
        ExperimentTest::SetUp();
        write("gripper.urdf", gripper);
    }

    std::string refusal(const std::string& text) {
        try {
            run(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    static bool has_mujoco() { return fs::exists(library_folder() / "foam/engines/foam-engine-mujoco-grasp"); }
};

TEST_F(ThroughputTest, Refusals) {
    EXPECT_EQ(findings(whole), "");
    EXPECT_EQ(findings(head),
              "x.yaml:1:1: error[missing-key]: 'robot' is missing; remedy: write robot: FILE.urdf\n"
              "x.yaml:1:1: error[missing-key]: 'spheres' is missing; remedy: write spheres: [11, 22]\n"
              "x.yaml:1:1: error[missing-key]: 'method' is missing; remedy: write method: spherize.medial\n"
              "x.yaml:1:1: error[missing-key]: 'fingers' is missing; remedy: write fingers: [left, right]\n"
              "x.yaml:1:1: error[missing-key]: 'motion' is missing; remedy: write motion: [{time: 0, joints: {elbow: "
              "0}}, {time: 1, joints: {elbow: 1}}]\n");
    const std::string good = head + "robot: a.urdf\nspheres: [3]\nmethod: spherize.grid\nfingers: left\n";
    EXPECT_EQ(findings(good + "motion: [{time: 1}, {time: 1, joint: {a: 0}}]\n"),
              "x.yaml:8:21: error[out-of-order]: 'motion' expects ascending times, got 1 after 1\n"
              "x.yaml:8:31: error[unknown-key]: unknown key 'joint' in motion; did you mean 'joints'?\n");
    EXPECT_EQ(findings(good + "motion: [{time: 1}]\nobject: {size: [1, 2]}\n"),
              "x.yaml:8:9: error[wrong-type]: 'motion' expects at least two moments\n"
              "x.yaml:9:16: error[wrong-type]: 'size' expects three numbers, got 2; remedy: write size: [0.1, 0.1, "
              "0.1]\n");
}

TEST_F(ThroughputTest, TheSceneHasWhatTheRobotHas) {
    auto robot = std::make_shared<Robot>();
    robot->name = "r";
    robot->root = "a";
    for (const char* name : {"a", "b<"}) {
        robot->links.push_back({.name = name, .collisions = {}, .visuals = {}});
    }
    robot->joints.push_back({.name = "j",
                             .kind = Joint::Kind::revolute,
                             .parent = "a",
                             .child = "b<",
                             .origin = Pose{.translation = {1, 2, 3}},
                             .axis = {0, 0, 1},
                             .lower = -1,
                             .upper = 1});
    const Kinematics kinematics(robot);
    const Solid::Part box{
        .mesh = nullptr, .primitive = Element::box({0.2, 0.2, 0.1}), .pose = {}};
    const std::vector<GraspLink> links{{nullptr, {}}, {Solid::make({box}), {}}};
    const GraspScene scene = grasp_scene(kinematics, links, {.excluded = {{0, 1}}, .object_ignores = {1}});
    EXPECT_THAT(scene.joints, ElementsAre(0));
    EXPECT_EQ(scene.object, (Vec3{0.5, 0, 0.05}));
    // 4 kg; 4 / 12 · (0.2² + 0.1²) and 4 / 12 · (0.2² + 0.2²).
    EXPECT_THAT(
        scene.text,
        HasSubstr("<body name=\"b&lt;\" pos=\"1 2 3\" xyaxes=\"1 0 0 0 1 0\"><inertial pos=\"0 0 0\" mass=\"4"));
    EXPECT_THAT(scene.text, HasSubstr("<geom type=\"box\" size=\"0.1 0.1 0.05\" pos=\"0 0 0\""));
    EXPECT_THAT(scene.text, HasSubstr("<exclude body1=\"a\" body2=\"b&lt;\"/>\n"
                                      "<exclude body1=\"b&lt;\" body2=\"object\"/>\n"));
    const GraspScene balls = grasp_scene(kinematics, {links[0], {links[1].solid, {{{0, 0, 0.5}, 0.25}}}}, {});
    EXPECT_THAT(balls.text, HasSubstr("<geom type=\"sphere\" size=\"0.25\" pos=\"0 0 0.5\"/>"));
    EXPECT_THAT(balls.text, testing::Not(HasSubstr("size=\"0.1 0.1 0.05\"")));
}

TEST_F(ThroughputTest, AGripperLiftsABox) {
    if (!has_mujoco()) {
        EXPECT_EQ(refusal(whole), "the program foam-engine-mujoco-grasp is not built; remedy: apt-get install "
                                  "libmujoco-dev, then configure and build foam again");
        GTEST_SKIP() << "libmujoco-dev is absent";
    }
    const ExperimentResult result = run(whole);
    const Table table = parse_csv(result.csv, "results.csv");
    ASSERT_EQ(table.rows.size(), 4u); // two models, two repeats
    for (const std::vector<std::string>& row : table.rows) {
        EXPECT_EQ(row[3], "500") << row[0]; // two simulations of 250 steps
        EXPECT_EQ(row[9], "2") << row[0] << ": gripped";
        EXPECT_EQ(row[10], "2") << row[0] << ": lifted";
        EXPECT_NEAR(std::stod(row[11]), 0.1, 0.02) << row[0];
    }
    EXPECT_EQ(table.rows[0][0], "original");
    EXPECT_EQ(table.rows[2][0], "3 spheres");
    EXPECT_THAT(result.markdown, HasSubstr("| original |"));
}

TEST_F(ThroughputTest, AGripperThatStaysOpenLiftsNothing) {
    if (!has_mujoco()) {
        GTEST_SKIP() << "libmujoco-dev is absent";
    }
    std::string open = whole;
    open.replace(open.find("open: 0}"), 8, "open: 0.06}");
    for (const std::vector<std::string>& row : parse_csv(run(open).csv, "results.csv").rows) {
        EXPECT_EQ(row[9], "0");
        EXPECT_EQ(row[10], "0");
    }
}

TEST_F(ThroughputTest, NamesThatTheRobotLacks) {
    if (!has_mujoco()) {
        GTEST_SKIP() << "libmujoco-dev is absent";
    }
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(refusal(with("[left, right]", "[left, thumb]")), HasSubstr("gripper.urdf: there is no link 'thumb'"));
    EXPECT_EQ(refusal(with("{up: 0.1}", "{down: 0.1}")),
              "a value is given for joint 'down', but robot 'gripper' has no such joint");
}

} // namespace
} // namespace foam::experiment
