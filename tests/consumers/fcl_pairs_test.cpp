// FCL, on the original meshes in random poses: no pair of links that foam leaves out touches, unless it touches in all.
#include "support/shared_folder.hpp"

#include <foam/collision/consequences.hpp>
#include <foam/judge/collision_model.hpp>

#include <fcl/fcl.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace foam::test {
namespace {

namespace fs = std::filesystem;
using Bvh = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Bvh> bvh_of(const Mesh& mesh) {
    std::vector<fcl::Vector3d> vertices;
    for (const Vec3& v : mesh.vertices) {
        vertices.emplace_back(v.x, v.y, v.z);
    }
    std::vector<fcl::Triangle> triangles;
    for (const auto& [a, b, c] : mesh.triangles) {
        triangles.emplace_back(a, b, c);
    }
    auto model = std::make_shared<Bvh>();
    model->beginModel();
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
}

fcl::Transform3d transform_of(const Pose& pose) {
    fcl::Transform3d result = fcl::Transform3d::Identity();
    const auto& [x, y, z] = pose.rotation;
    result.linear() << x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z;
    result.translation() << pose.translation.x, pose.translation.y, pose.translation.z;
    return result;
}

/// Returns the folder of robots in the PyPI package example-robot-data, which CI installs; it may not exist.
fs::path example_robots() {
    std::error_code none;
    for (const fs::directory_entry& python : fs::directory_iterator(FOAM_TEST_PYTHON "/lib", none)) {
        const fs::path robots = python.path() / "site-packages/cmeel.prefix/share/example-robot-data/robots";
        if (fs::exists(robots)) {
            return robots;
        }
    }
    return "example-robot-data";
}

class FclOnPairs : public ::testing::TestWithParam<const char*> {
protected:
    void check(const fs::path& file);
};
class FclOnPairsOfHands : public FclOnPairs {};

TEST_P(FclOnPairs, NoPairThatIsLeftOutTouches) {
    check(shared_folder() / GetParam());
}

TEST_P(FclOnPairsOfHands, NoPairThatIsLeftOutTouches) {
    const fs::path file = example_robots() / GetParam();
    ASSERT_TRUE(fs::exists(file) || !std::getenv("CI")) << "tests/consumers/python/robots.txt is not installed";
    check(file);
}

void FclOnPairs::check(const fs::path& file) {
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is absent";
    }
    Registry registry;
    for (const char* name : {"load_urdf", "load_mesh", "spherize_cover"}) {
        ASSERT_TRUE(registry.load(fs::path(FOAM_TEST_PLUGINS) / (name + std::string(".so"))).loaded());
    }
    const CollisionModel model = load_collision_model(file, registry, 8);
    const Kinematics kinematics(model.robot);
    const SelfCollisionMatrix matrix =
        self_collision_matrix(kinematics, model, {.samples = 20000, .proof_boxes = 2000});
    std::vector<std::shared_ptr<Bvh>> shapes;
    for (const auto& solid : model.solids) {
        shapes.push_back(solid ? bvh_of(solid->surface()) : nullptr);
    }
    constexpr std::size_t poses = 3000;
    std::vector<std::size_t> touching(matrix.pairs.size(), 0);
    for (const std::vector<double>& configuration : random_configurations(kinematics, poses, 77)) {
        const std::vector<Pose> placed = kinematics.link_poses(configuration);
        for (std::size_t i = 0; i < matrix.pairs.size(); ++i) {
            const LinkPair& pair = matrix.pairs[i];
            if (pair.reason != PairReason::none && pair.reason != PairReason::adjacent) {
                fcl::CollisionResultd result;
                touching[i] += fcl::collide(shapes[pair.first].get(), transform_of(placed[pair.first]),
                                            shapes[pair.second].get(), transform_of(placed[pair.second]),
                                            fcl::CollisionRequestd(), result);
            }
        }
    }
    for (std::size_t i = 0; i < matrix.pairs.size(); ++i) {
        const LinkPair& pair = matrix.pairs[i];
        EXPECT_TRUE(touching[i] == 0 || (pair.reason == PairReason::always && touching[i] == poses))
            << model.robot->links[pair.first].name << ", " << model.robot->links[pair.second].name << ": "
            << to_string(pair.reason) << ", but FCL finds contact in " << touching[i] << " poses";
        EXPECT_NE(pair.reason, PairReason::default_pose);
    }
}

INSTANTIATE_TEST_SUITE_P(PyPI, FclOnPairsOfHands,
                         ::testing::Values("allegro_hand_description/urdf/allegro_right_hand.urdf",
                                           "romeo_description/urdf/romeo.urdf", "pr2_description/urdf/pr2.urdf"));
INSTANTIATE_TEST_SUITE_P(
    Shared, FclOnPairs,
    ::testing::Values("robots/panda/moveit_resources_panda_description/urdf/panda.urdf",
                      "robots/fetch/fetch_description/robots/fetch.urdf",
                      "robots/baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf",
                      "robots/ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
                      "robots/jaco/kinova_description/urdf/j2s7s300.urdf", "robots/iiwa/model.urdf",
                      "robots/stretch/RE1V0/stretch_description_RE1V0_tool_stretch_gripper.urdf"));

} // namespace
} // namespace foam::test
