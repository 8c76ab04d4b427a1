// The joints between two links, against the poses of the links in a tree.
#include "geometry/plain_shapes.hpp"

#include <foam/robot/internal/chain.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using namespace robot::joint_chain;
using Kind = Joint::Kind;

/// A tree of links whose joints are of kinds in turn, with axes and origins at random; the second half of them mimics.
std::shared_ptr<const Robot> tree_at_random(Random& random, std::size_t links, const std::vector<Kind>& kinds) {
    Robot robot;
    robot.name = "tree";
    robot.root = "l0";
    for (std::size_t i = 0; i < links; ++i) {
        robot.links.push_back({.name = "l" + std::to_string(i), .collisions = {}, .visuals = {}});
    }
    for (std::size_t i = 1; i < links; ++i) {
        robot.joints.push_back({.name = "j" + std::to_string(i), .kind = kinds[i % kinds.size()],
                                .parent = "l" + std::to_string(random.below(i)), .child = "l" + std::to_string(i),
                                .origin = random_pose(random, 1), .axis = random_direction(random), .lower = -1, .upper = 1});
        if (i == 4) {
            robot.joints.back().mimic = Mimic{.joint = "j1", .multiplier = -2, .offset = 0.5};
        }
    }
    return std::make_shared<const Robot>(std::move(robot));
}

void expect_same(const Pose& a, const Pose& b) {
    for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        ASSERT_LE(distance(a * p, b * p), 1e-12);
    }
}

/// The links from one up to the root.
std::vector<std::size_t> upwards(const Kinematics& kinematics, std::size_t link) {
    std::vector<std::size_t> way{link};
    while (kinematics.joint_above()[way.back()]) {
        way.push_back(kinematics.link_above()[*kinematics.joint_above()[way.back()]]);
    }
    return way;
}

/// The links below the lowest one that is above both, and that one.
std::pair<std::vector<std::size_t>, std::size_t> between(const Kinematics& kinematics, std::size_t a, std::size_t b) {
    const std::vector<std::size_t> of_a = upwards(kinematics, a), of_b = upwards(kinematics, b);
    const auto has = [](const std::vector<std::size_t>& way, std::size_t link) {
        return std::find(way.begin(), way.end(), link) != way.end();
    };
    std::vector<std::size_t> links;
    std::copy_if(of_a.begin(), of_a.end(), std::back_inserter(links), [&](std::size_t l) { return !has(of_b, l); });
    std::copy_if(of_b.rbegin(), of_b.rend(), std::back_inserter(links), [&](std::size_t l) { return !has(of_a, l); });
    return {links, *std::find_if(of_a.begin(), of_a.end(), [&](std::size_t l) { return has(of_b, l); })};
}

TEST(Chain, LeadsFromLinkToLinkAsTheTreeDoes) {
    Random random(1);
    const std::vector<Kind> kinds{Kind::revolute, Kind::fixed, Kind::prismatic, Kind::revolute, Kind::planar, Kind::revolute,
                                  Kind::prismatic, Kind::floating, Kind::revolute};
    for (int round = 0; round < 20; ++round) {
        const Kinematics kinematics(tree_at_random(random, 9, kinds));
        const std::vector<double> configuration = kinematics.random_configuration(random);
        const std::vector<Pose> poses = kinematics.link_poses(configuration);
        for (std::size_t a = 0; a < poses.size(); ++a) {
            for (std::size_t b = 0; b < poses.size(); ++b) {
                const Chain chain = chain_between(kinematics, a, b);
                const Pose relative = poses[a].inverse() * poses[b];
                std::vector<Axis> axes(chain.steps.size());
                expect_same(forward(chain, configuration, axes), relative);
                const auto [links, meeting] = between(kinematics, a, b);
                const Way way = way_between(kinematics, a, b);
                std::vector<std::size_t> on_way = way.up;
                on_way.insert(on_way.end(), way.down.begin(), way.down.end());
                EXPECT_EQ(on_way, links);
                EXPECT_EQ(way.meeting, meeting);
                bool unbounded = false;
                std::size_t step = 0;
                for (const std::size_t link : links) {
                    const std::size_t above = *kinematics.joint_above()[link];
                    const Joint& joint = kinematics.robot().joints[above];
                    unbounded = unbounded || joint.kind == Kind::planar || joint.kind == Kind::floating;
                    if (kinematics.motions()[above].freedom) { // the joint turns where its frame is, in either direction
                        ASSERT_LT(step, chain.steps.size());
                        EXPECT_EQ(chain.steps[step].joint, &joint);
                        const Pose frame = poses[a].inverse() * poses[kinematics.link_above()[above]] * joint.origin;
                        EXPECT_LE(distance(axes[step].direction, frame.rotate(joint.axis)), 1e-12);
                        const Vec3 off = axes[step].origin - frame.translation;
                        EXPECT_LE(norm(joint.kind == Kind::revolute ? off : cross(off, axes[step].direction)), 1e-12);
                        ++step;
                    }
                }
                EXPECT_EQ(step, chain.steps.size());
                EXPECT_EQ(chain.unbounded, unbounded) << a << " " << b;
                for (std::size_t cut = 0; cut <= chain.steps.size(); ++cut) {
                    const SplitChain parts = split(chain, cut);
                    ASSERT_EQ(parts.first.steps.size(), cut);
                    const Pose to_a = forward(parts.first, configuration, axes), to_b = forward(parts.second, configuration, axes);
                    expect_same(to_a.inverse() * to_b, relative);
                }
            }
        }
    }
}

TEST(Chain, LinksAreAdjacentThatAtMostOneJointMovesWithNothingInBetween) {
    Random random(2);
    int adjacent_ones = 0, others = 0;
    for (int round = 0; round < 60; ++round) {
        const Kinematics kinematics(tree_at_random(random, 7, {Kind::revolute, Kind::fixed, Kind::fixed, Kind::floating}));
        std::vector<bool> geometry;
        for (std::size_t link = 0; link < 7; ++link) {
            geometry.push_back(random.uniform() < 0.4);
        }
        for (std::size_t a = 0; a < geometry.size(); ++a) {
            for (std::size_t b = 0; b < geometry.size(); ++b) {
                auto [links, meeting] = between(kinematics, a, b);
                int movable = 0, solid = geometry[meeting] && meeting != a && meeting != b ? 1 : 0;
                for (const std::size_t link : links) {
                    movable += kinematics.robot().joints[*kinematics.joint_above()[link]].kind != Kind::fixed ? 1 : 0;
                    solid += geometry[link] && link != a && link != b ? 1 : 0;
                }
                const bool expected = movable <= 1 && solid == 0;
                EXPECT_EQ(adjacent(kinematics, geometry, a, b), expected) << a << " " << b;
                (expected ? adjacent_ones : others) += 1;
            }
        }
    }
    EXPECT_GT(adjacent_ones, 100);
    EXPECT_GT(others, 100);
}

} // namespace
} // namespace foam::test
