// MuJoCo's own parser on what write.mjcf writes: bodies, spheres to the last bit, poses, pairs without contact.
#include "models.hpp"
#include "support/temporary_folder.hpp"

#include <foam/base/file.hpp>
#include <foam/base/random.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/robot/kinematics.hpp>
#include <foam/sdk/stage.hpp>

#include <gtest/gtest.h>

#include <mujoco/mujoco.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace {

using namespace foam;
using namespace foam::test;

/// Returns the text without limits of joints that MuJoCo before 2.3.7 has no word for: it refuses the file.
std::string in_words_of_this_version(const std::string& text) {
    return mj_version() < 237 ? std::regex_replace(text, std::regex(" actuatorfrcrange=\"[^\"]*\""), "") : text;
}

struct Loaded {
    explicit Loaded(const std::string& text) {
        const TemporaryFolder folder; // cases run at once
        const std::string file = (folder.path() / "model.xml").string();
        std::ofstream(file) << in_words_of_this_version(text);
        char error[1000] = "";
        model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
        EXPECT_TRUE(model) << error;
        data = model ? mj_makeData(model) : nullptr;
    }
    ~Loaded() {
        mj_deleteData(data);
        mj_deleteModel(model);
    }
    mjModel* model = nullptr;
    mjData* data = nullptr;
};

std::shared_ptr<const Robot> panda() {
    const std::filesystem::path file = FOAM_TEST_SOURCE "/configs/robots/panda/panda.urdf";
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/load_urdf.so");
    QuietContext context;
    return std::make_shared<Robot>(registry.make<RobotLoader>("load.urdf")->load(
        text.str(), file, ResourceResolver::from_environment(), context));
}

/// Two spheres a link, with numbers that need all digits.
SphereModel spheres_on(const std::shared_ptr<const Robot>& robot) {
    SphereModel model;
    model.name = "test";
    model.robot = robot;
    Random random(5);
    for (const Link& link : robot->links) {
        if (!link.collisions.empty()) {
            std::vector<Sphere> spheres;
            for (int i = 0; i < 2; ++i) {
                spheres.push_back({{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 1.0 / 3}, random.uniform(0.01, 0.02)});
            }
            model.groups.push_back({link.name, {}, flat_tree(spheres), {}});
        }
    }
    return model;
}

TEST(MuJoCo, HoldsTheSameSpheresAtTheSamePoses) {
    const auto robot = panda();
    const SphereModel model = spheres_on(robot);
    QuietContext context;
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    const Kinematics kinematics(robot);
    EXPECT_EQ(mujoco.model->ngeom, 22);
    EXPECT_EQ(static_cast<std::size_t>(mujoco.model->nbody), robot->links.size() + 1) << "and the world";
    Random random(9);
    for (int round = 0; round < 3; ++round) {
        const std::vector<double> configuration = kinematics.random_configuration(random);
        const std::vector<double> values = kinematics.joint_values(configuration);
        for (std::size_t j = 0; j < robot->joints.size(); ++j) {
            const int id = mj_name2id(mujoco.model, mjOBJ_JOINT, robot->joints[j].name.c_str());
            if (robot->joints[j].kind != Joint::Kind::fixed) {
                ASSERT_GE(id, 0) << robot->joints[j].name;
                mujoco.data->qpos[mujoco.model->jnt_qposadr[id]] = values[j];
            }
        }
        mj_kinematics(mujoco.model, mujoco.data);
        const std::vector<Pose> poses = kinematics.link_poses(configuration);
        for (const SphereGroup& group : model.groups) {
            const int body = mj_name2id(mujoco.model, mjOBJ_BODY, group.link.c_str());
            ASSERT_GE(body, 0);
            ASSERT_EQ(mujoco.model->body_geomnum[body], 2);
            const auto link = static_cast<std::size_t>(robot->find_link(group.link) - robot->links.data());
            for (int i = 0; i < 2; ++i) {
                const int geom = mujoco.model->body_geomadr[body] + i;
                const Sphere& sphere = group.tree.finest()[static_cast<std::size_t>(i)];
                const mjtNum* at = mujoco.model->geom_pos + 3 * geom;
                EXPECT_EQ(Vec3(at[0], at[1], at[2]), sphere.center);
                EXPECT_EQ(mujoco.model->geom_size[3 * geom], sphere.radius);
                const mjtNum* in_world = mujoco.data->geom_xpos + 3 * geom;
                EXPECT_LT(distance({in_world[0], in_world[1], in_world[2]}, poses[link] * sphere.center), 1e-12);
            }
        }
    }
}

TEST(MuJoCo, LeavesOutIgnoredPairsAlsoAtTheBase) {
    const auto robot = panda();
    SphereModel model = spheres_on(robot);
    for (SphereGroup& group : model.groups) {
        group.tree = flat_tree({{{0, 0, 0}, 0.3}}); // neighbours overlap
    }
    const auto contacts = [&] {
        QuietContext context;
        const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
        mj_forward(mujoco.model, mujoco.data);
        return mujoco.data->ncon;
    };
    EXPECT_GT(contacts(), 0);
    model.ignored_pairs.emplace();
    for (const SphereGroup& a : model.groups) {
        for (const SphereGroup& b : model.groups) {
            model.ignored_pairs->push_back({a.link, b.link, ""});
            if (&a == &b) {
                model.ignored_pairs->pop_back();
            }
        }
    }
    EXPECT_EQ(contacts(), 0);
    QuietContext context;
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    for (int step = 0; step < 1000; ++step) {
        mj_step(mujoco.model, mujoco.data);
        ASSERT_EQ(mujoco.data->ncon, 0) << step;
    }
}

TEST(MuJoCo, TakesTheMassAndInertiaOfTheGeometry) {
    const auto robot = panda();
    SphereModel model = spheres_on(robot);
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/load_mesh.so");
    const auto loader = registry.make<MeshLoader>("load.mesh");
    QuietContext context;
    for (const Link& link : robot->links) {
        std::vector<Solid::Part> parts;
        for (const GeometryElement& element : link.collisions) {
            const auto& mesh = std::get<MeshReference>(element.geometry);
            parts.push_back({std::make_shared<const Mesh>(
                                 transformed(loader->load(mesh.path, context), element.origin, mesh.scale)),
                             std::nullopt, Pose{}});
        }
        if (!parts.empty()) {
            model.geometry[link.name] = Solid::make(std::move(parts));
        }
    }
    const Loaded mujoco(writer("xml_models", "write.mjcf", {{"density", 500.0}})->write(model, context));
    ASSERT_TRUE(mujoco.model);
    for (const auto& [link, solid] : model.geometry) {
        const int body = mj_name2id(mujoco.model, mjOBJ_BODY, link.c_str());
        const auto mass = mass_properties(*solid, 500);
        ASSERT_TRUE(body >= 0 && mass);
        EXPECT_EQ(mujoco.model->body_mass[body], mass->mass) << link;
        const mjtNum *at = mujoco.model->body_ipos + 3 * body, *inertia = mujoco.model->body_inertia + 3 * body;
        EXPECT_LT(distance({at[0], at[1], at[2]}, mass->center), 1e-12) << link;
        // The principal moments have the trace of the matrix.
        const double trace = mass->inertia[0] + mass->inertia[1] + mass->inertia[2];
        EXPECT_NEAR(inertia[0] + inertia[1] + inertia[2], trace, 1e-9 * trace) << link;
    }
}

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

/// A robot of this URDF, and a sphere on the link `tip`.
SphereModel sphere_on_tip(const std::string& urdf) {
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/load_urdf.so");
    QuietContext context;
    SphereModel model;
    model.name = "two";
    model.robot =
        std::make_shared<Robot>(registry.make<RobotLoader>("load.urdf")
                                    ->load(urdf, "/none/two.urdf", ResourceResolver::from_environment(), context));
    model.groups.push_back({"tip", {}, flat_tree({{{0, 0, 0}, 0.1}}), {}});
    return model;
}

std::string two_links(const std::string& base, const std::string& inertial) {
    return "<robot name=\"two\"><link name=\"" + base + "\"/><link name=\"tip\">" + inertial +
           "</link><joint name=\"j\" type=\"continuous\"><parent link=\"" + base +
           "\"/><child link=\"tip\"/><origin xyz=\"0 0 1\"/></joint></robot>";
}

std::string inertial_of(double mass, double ixx, double iyy, double izz) {
    std::ostringstream text;
    text << "<inertial><mass value=\"" << mass << "\"/><inertia ixx=\"" << ixx << "\" iyy=\"" << iyy << "\" izz=\""
         << izz << "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>";
    return text.str();
}

TEST(MuJoCo, RefusesInertiasThatNoBodyHasSoTheyAreMended) {
    for (const auto& [ixx, iyy, izz] : {Vec3{0, 0, 0}, Vec3{-1, 1, 1}}) {
        WarningContext context;
        const SphereModel model = sphere_on_tip(two_links("base", inertial_of(3, ixx, iyy, izz)));
        const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
        ASSERT_TRUE(mujoco.model);
        EXPECT_EQ(mujoco.model->body_mass[mj_name2id(mujoco.model, mjOBJ_BODY, "tip")], 3) << "the mass stays";
        ASSERT_EQ(context.warnings.size(), 1u);
        EXPECT_EQ(context.warnings[0].find("MuJoCo refuses the inertia that the robot states for tip (/none/two."), 0u);
    }
    WarningContext context;
    const SphereModel model = sphere_on_tip(two_links("base", inertial_of(3, 2, 3, 4)));
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    EXPECT_EQ(mujoco.model->body_inertia[3 * mj_name2id(mujoco.model, mjOBJ_BODY, "tip")], 4) << "as stated";
    EXPECT_TRUE(context.warnings.empty());
}

TEST(MuJoCo, AMomentLargerThanTheOthersTogetherIsBalanced) {
    WarningContext context;
    const SphereModel model = sphere_on_tip(two_links("base", inertial_of(3, 1, 1, 5.5)));
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    const int tip = mj_name2id(mujoco.model, mjOBJ_BODY, "tip");
    EXPECT_EQ(mujoco.model->body_mass[tip], 3);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(mujoco.model->body_inertia[3 * tip + i], 2.5) << "the mean";
    }
    EXPECT_EQ(context.warnings,
              std::vector<std::string>{
                  "MuJoCo refuses the inertia that the robot states for tip (/none/two.urdf:1): a principal moment is "
                  "larger than the sum of the two others, which no body has; the mean of the three takes their place, "
                  "as with balanceinertia of MuJoCo; remedy: correct <inertial>"});
}

TEST(MuJoCo, APlateIsABodyThoughItsMomentsAreRounded) {
    for (const double izz : {0.3, 0.1 + 0.2, 0.3 * (1 + 1e-10)}) { // 0.1 + 0.2 is above 0.3
        WarningContext context;
        std::string urdf = two_links("base", inertial_of(3, 0.1, 0.2, 0));
        urdf.replace(urdf.find("izz=\"0\""), 7, "izz=\"" + number_text(izz) + "\"");
        const Loaded mujoco(writer("xml_models", "write.mjcf")->write(sphere_on_tip(urdf), context));
        ASSERT_TRUE(mujoco.model);
        EXPECT_NEAR(mujoco.model->body_inertia[3 * mj_name2id(mujoco.model, mjOBJ_BODY, "tip")], izz, 1e-10);
        EXPECT_TRUE(context.warnings.empty());
    }
}

/// A sphere on a link that moves, with the mass that its geometry has.
SphereModel small_ball(double radius) {
    SphereModel model = sphere_on_tip(two_links("base", ""));
    model.groups = {{"tip", {}, flat_tree({{{0, 0, 0}, radius}}), {}}};
    model.geometry["tip"] = Solid::make({{nullptr, Element::sphere(radius), Pose{}}});
    return model;
}

TEST(MuJoCo, RefusesInertiasOfSmallBodiesSoTheyAreRaised) {
    for (const double radius : {1e-4, 1e-6}) {
        SCOPED_TRACE(radius);
        WarningContext context;
        const SphereModel model = small_ball(radius);
        const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
        ASSERT_TRUE(mujoco.model);
        const int tip = mj_name2id(mujoco.model, mjOBJ_BODY, "tip");
        const double mass = mass_properties(*model.geometry.at("tip"), 1000)->mass;
        EXPECT_DOUBLE_EQ(mujoco.model->body_mass[tip], std::max(mass, 2e-14));
        EXPECT_DOUBLE_EQ(mujoco.model->body_inertia[3 * tip], 2e-14);
        ASSERT_EQ(context.warnings.size(), 2U) << "and that the mass is of the geometry";
        EXPECT_EQ(context.warnings[0],
                  "MuJoCo refuses a mass below 1e-14 kg and a moment of inertia below 1e-14 kg m²; "
                  "those of tip are raised to at least 2e-14; remedy: a robot in other units, such "
                  "as millimetres");
    }
    WarningContext context;
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(small_ball(1e-3), context));
    ASSERT_TRUE(mujoco.model);
    EXPECT_EQ(context.warnings.size(), 1U) << "a millimetre is no small body";
}

TEST(MuJoCo, ASmallInertiaThatTheUrdfStatesIsThatOfABody) {
    WarningContext context;
    const SphereModel model = sphere_on_tip(two_links("base", inertial_of(1e-9, 2e-15, 3e-15, 4e-15)));
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    const int tip = mj_name2id(mujoco.model, mjOBJ_BODY, "tip");
    EXPECT_EQ(mujoco.model->body_mass[tip], 1e-9) << "as stated";
    EXPECT_NEAR(mujoco.model->body_inertia[3 * tip], 2.2e-14, 1e-20) << "all moments are raised alike";
    EXPECT_NEAR(mujoco.model->body_inertia[3 * tip + 2], 2e-14, 1e-20);
    ASSERT_EQ(context.warnings.size(), 1U);
    EXPECT_EQ(context.warnings[0].find("MuJoCo refuses a mass below 1e-14 kg"), 0U);
}

TEST(MuJoCo, AnInertialThatCannotBeReadIsRefusedWhereItIsNeeded) {
    const auto refusal = [](const std::string& inertial) {
        QuietContext context;
        try {
            writer("xml_models", "write.mjcf")->write(sphere_on_tip(two_links("base", inertial)), context);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal("\n<inertial>\n<mass value='heavy'/><inertia/></inertial>"),
              "/none/two.urdf:3: <inertia> has no ixx; remedy: add ixx=\"…\"");
    EXPECT_EQ(refusal("\n<inertial><mass value='1'/></inertial>"),
              "/none/two.urdf:2: <inertial> needs <mass> and <inertia> for MuJoCo");
}

TEST(MuJoCo, ALinkCalledWorldIsTheWorld) {
    QuietContext context;
    SphereModel model = sphere_on_tip(two_links("world", inertial_of(3, 2, 3, 4)));
    model.ignored_pairs = {{"tip", "world", ""}};
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    EXPECT_EQ(mujoco.model->nbody, 2);
    EXPECT_EQ(mujoco.model->body_parentid[mj_name2id(mujoco.model, mjOBJ_BODY, "tip")], 0);
    EXPECT_EQ(mujoco.model->nexclude, 0);
    model.groups.push_back({"world", {}, flat_tree({{{0, 0, 0}, 0.1}}), {}});
    EXPECT_THROW(writer("xml_models", "write.mjcf")->write(model, context), Error)
        << "the world's spheres are of a link";
}

TEST(MuJoCo, AGeomThatOneReplacesIsFoundByItsName) {
    SphereModel model = sphere_on_tip(two_links("base", inertial_of(3, 2, 3, 4)));
    model.into = TextFile{"arm.xml", R"(<mujoco><worldbody>
      <body name="tip"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint name="j"/>
        <geom name="foot" size="0.2" pos="1 0 0"/><site name="s" pos="0 0 -1"/><site name="t" pos="0 0 1"/></body>
      <geom name="floor" type="plane" size="1 1 .1"/></worldbody>
      <contact><pair geom1="floor" geom2="foot"/></contact>
      <sensor><framepos objtype="geom" objname="foot"/></sensor>
      <tendon><spatial><site site="s"/><geom geom="foot"/><site site="t"/></spatial></tendon>
      <custom><tuple name="one"><element objtype="geom" objname="foot"/></tuple></custom></mujoco>)"};
    QuietContext context;
    const Loaded mujoco(writer("xml_models", "write.mjcf")->write(model, context));
    ASSERT_TRUE(mujoco.model);
    const int foot = mj_name2id(mujoco.model, mjOBJ_GEOM, "foot");
    ASSERT_GE(foot, 0);
    EXPECT_EQ(mujoco.model->geom_size[3 * foot], 0.1);
    EXPECT_EQ(mujoco.model->npair, 1);
}

TEST(MuJoCo, LockedAndMimickedJoints) {
    const auto robot = panda();
    SphereModel model = spheres_on(robot);
    QuietContext context;
    const Loaded free(writer("xml_models", "write.mjcf")->write(model, context));
    EXPECT_EQ(free.model->neq, 1) << "the second finger follows the first";
    model.facts.lock_joints = {{"panda_joint7", 0.5}};
    const Loaded locked(writer("xml_models", "write.mjcf")->write(model, context));
    EXPECT_EQ(locked.model->njnt, free.model->njnt - 1);
    mj_kinematics(locked.model, locked.data);
    const int body = mj_name2id(locked.model, mjOBJ_BODY, "panda_hand");
    for (int j = 0; j < locked.model->njnt; ++j) {
        locked.data->qpos[j] = 0;
    }
    const auto zero = link_poses(*robot, [&] {
        JointValues values{{"panda_joint7", 0.5}};
        for (const Joint& joint : robot->joints) {
            if (joint.kind != Joint::Kind::fixed && joint.name != "panda_joint7") {
                values[joint.name] = 0;
            }
        }
        return values;
    }());
    mj_kinematics(locked.model, locked.data);
    const mjtNum* at = locked.data->xpos + 3 * body;
    EXPECT_LT(distance({at[0], at[1], at[2]}, zero.at("panda_hand").translation), 1e-12);
}

} // namespace
