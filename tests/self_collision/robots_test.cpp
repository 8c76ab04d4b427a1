// The robots of others: every pair is judged, neighbours are adjacent, MoveIt's list is met.
#include "support/shared_folder.hpp"

#include <foam/judge/collision_model.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace foam::test {
namespace {

namespace fs = std::filesystem;

class RobotsOfOthers : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"load_urdf", "load_mesh", "spherize_cover"}) {
            ASSERT_TRUE(registry.load(fs::path(FOAM_TEST_PLUGINS) / (name + std::string(".so"))).loaded());
        }
    }
    Registry registry;
};

class Robots : public RobotsOfOthers, public ::testing::WithParamInterface<const char*> {};

TEST_P(Robots, EveryPairIsJudged) {
    const fs::path file = shared_folder() / GetParam();
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is absent";
    }
    const CollisionModel model = load_collision_model(file, registry, 1);
    const Kinematics kinematics(model.robot);
    const SelfCollisionMatrix matrix = self_collision_matrix(kinematics, model, {.samples = 200, .proof_boxes = 50});
    const auto links = static_cast<std::size_t>(
        std::count_if(model.elements.begin(), model.elements.end(), [](const auto& s) { return !s.empty(); }));
    EXPECT_EQ(matrix.pairs.size(), links * (links - 1) / 2);
    std::set<std::pair<std::size_t, std::size_t>> adjacent;
    for (const LinkPair& pair : matrix.pairs) {
        EXPECT_LT(pair.first, pair.second);
        EXPECT_EQ(pair.samples > 0 || pair.geometry_samples == 1,
                  pair.reason != PairReason::adjacent && !pair.proved && !pair.unbounded);
        if (pair.reason == PairReason::adjacent) {
            adjacent.emplace(pair.first, pair.second);
        }
    }
    for (std::size_t link = 0; link < model.elements.size(); ++link) {
        if (const auto joint = kinematics.joint_above()[link]) {
            const std::size_t above = kinematics.link_above()[*joint];
            if (!model.elements[link].empty() && !model.elements[above].empty()) {
                EXPECT_TRUE(adjacent.contains(std::minmax(link, above))) << model.robot->links[link].name;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Shared, Robots,
    ::testing::Values("robots/baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf",
                      "robots/fetch/fetch_description/robots/fetch.urdf", "robots/iiwa/model.urdf",
                      "robots/jaco/kinova_description/urdf/j2s7s300.urdf",
                      "robots/stretch/foam_variant/stretch/stretch.urdf",
                      "robots/ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
                      "reference_spheres/foam/baxter_spherized_8.urdf", "reference_spheres/foam/fetch_spherized_8.urdf",
                      "reference_spheres/vamp/ur5_spherized.urdf"));

/// Pairs of names, in alphabetical order, with MoveIt's reasons.
std::map<std::set<std::string>, std::string> disabled_in(const fs::path& srdf) {
    std::ifstream stream(srdf, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::regex line(R"re(<disable_collisions link1="([^"]*)" link2="([^"]*)" reason="([^"]*)")re");
    std::map<std::set<std::string>, std::string> pairs;
    for (std::sregex_iterator it(text.begin(), text.end(), line), end; it != end; ++it) {
        pairs[{(*it)[1].str(), (*it)[2].str()}] = (*it)[3].str();
    }
    return pairs;
}

TEST_F(RobotsOfOthers, MoveItsListOfThePanda) {
    const fs::path folder = shared_folder() / "robots/panda";
    const fs::path file = folder / "moveit_resources_panda_description/urdf/panda.urdf";
    const fs::path srdf = folder / "foam_variant/panda.srdf";
    if (!fs::exists(file) || !fs::exists(srdf)) {
        GTEST_SKIP() << file << " or " << srdf << " is absent";
    }
    const CollisionModel model = load_collision_model(file, registry, 16);
    const SelfCollisionMatrix matrix =
        self_collision_matrix(Kinematics(model.robot), model, {.samples = 2000, .proof_boxes = 1000});
    const auto theirs = disabled_in(srdf);
    ASSERT_EQ(theirs.size(), 34u);
    std::size_t shared = 0, proved = 0;
    for (const LinkPair& pair : matrix.pairs) {
        const auto it = theirs.find({model.robot->links[pair.first].name, model.robot->links[pair.second].name});
        const std::string reason = it == theirs.end() ? "" : it->second;
        EXPECT_EQ(reason == "Adjacent", pair.reason == PairReason::adjacent);
        if (!reason.empty() && pair.reason != PairReason::none) {
            ++shared;
        }
        if (pair.proved) {
            ++proved;
            EXPECT_EQ(reason, "Never");
        }
    }
    EXPECT_GE(shared, 30u); // others touch by their spheres in poses that samples seldom find
    EXPECT_GE(proved, 10u);
}

} // namespace
} // namespace foam::test
