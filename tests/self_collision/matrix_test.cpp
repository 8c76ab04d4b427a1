// The self-collision matrix of robots whose answer is known: neighbours, proofs, poses, and what it writes.
#include "made_robot.hpp"

#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/judge/evaluate.hpp>

#include <gmock/gmock.h>

#include <cmath>

namespace foam::test {
namespace {

using std::numbers::pi;
using ::testing::ElementsAre;

TEST(SelfCollision, NeighboursThroughLinksWithoutGeometryAreAdjacent) {
    const SelfCollisionMatrix matrix = arm(-1, 1).matrix();
    ASSERT_EQ(matrix.pairs.size(), 3u);
    EXPECT_EQ(pair(matrix, 0, 1).reason, PairReason::adjacent);
    EXPECT_EQ(pair(matrix, 1, 3).reason, PairReason::adjacent);
    EXPECT_EQ(pair(matrix, 0, 3).reason, PairReason::never);
}

TEST(SelfCollision, ProvedUpToTheLimitWhereItEnds) {
    const auto verdict = [](double lower, double upper) { return pair(arm(lower, upper).matrix(), 0, 3); };
    EXPECT_TRUE(verdict(-touches_from + 1e-4, touches_from - 1e-4).proved);
    EXPECT_EQ(verdict(-touches_from + 1e-4, touches_from - 1e-4).reason, PairReason::never);
    EXPECT_NE(verdict(0, touches_from + 1e-3).reason, PairReason::never);
    EXPECT_TRUE(verdict(touches_from + 1e-4, pi).proved);
    EXPECT_EQ(verdict(touches_from + 1e-4, pi).reason, PairReason::always);
    EXPECT_NE(verdict(touches_from - 1e-3, pi).reason, PairReason::always);
}

TEST(SelfCollision, TheReferencePoseLeavesAPairOutOnDemandAlone) {
    const auto verdict = [](const JointValues& reference, bool by_pose) {
        CollisionModel model = arm(-pi, pi).model();
        model.solids = solids_of_spheres(model);
        return pair(
            self_collision_matrix(Kinematics(model.robot), model, {.reference = reference, .by_pose = by_pose}), 0, 3);
    };
    EXPECT_EQ(verdict({{"upper_lower", pi}}, false).reason, PairReason::none);
    EXPECT_EQ(verdict({{"upper_lower", pi}}, true).reason, PairReason::default_pose);
    EXPECT_GT(verdict({{"upper_lower", pi}}, true).touching, 0u);
    EXPECT_EQ(verdict({{"upper_lower", 1}}, true).reason, PairReason::none);
    EXPECT_THROW(verdict({{"wrist", 1}}, false), Error);
}

TEST(SelfCollision, OneConfigurationDecidesAboutLinksThatNoJointMoves) {
    const auto verdict = [](double share) {
        CollisionModel model = Builder()
                                   .link("a", {{{0, 0, 0}, 0.2}})
                                   .link("b", {{{0, 0, 0}, 0.01}})
                                   .link("c", {{{0, 0, 0}, 0.2}})
                                   .joint(fixed, "a", "b", {0.15, 0, 0})
                                   .joint(fixed, "b", "c", {0.15, 0, 0})
                                   .model();
        model.sources.assign(3, CollisionModel::Source::cover);
        CollisionModel small = model;
        for (Elements& elements : small.elements) {
            elements.spheres().front().radius *= share;
        }
        model.solids = solids_of_spheres(small);
        return pair(self_collision_matrix(Kinematics(model.robot), model, {}), 0, 2);
    };
    EXPECT_EQ(verdict(0.9).reason, PairReason::always);
    EXPECT_EQ(verdict(0.9).geometry_samples, 1u);
    EXPECT_EQ(verdict(0.5).reason, PairReason::never);
    EXPECT_FALSE(verdict(0.5).touches_by_elements_alone);
}

TEST(SelfCollision, LinksThatAreFixedToOneAnother) {
    const Builder rigid = Builder()
                              .link("a", {{{0, 0, 0}, 0.1}})
                              .link("b", {{{0, 0, 0}, 0.1}})
                              .link("c", {{{0, 0, 0}, 0.1}})
                              .link("d", {{{0.15, 0, 0}, 0.1}})
                              .joint(fixed, "a", "b", {1, 0, 0})
                              .joint(fixed, "b", "c", {1, 0, 0})
                              .joint(fixed, "c", "d", {-2, 0, 0});
    const SelfCollisionMatrix matrix = rigid.matrix();
    EXPECT_EQ(pair(matrix, 0, 1).reason, PairReason::adjacent);
    EXPECT_EQ(pair(matrix, 0, 2).reason, PairReason::never);
    EXPECT_EQ(pair(matrix, 0, 3).reason, PairReason::always);
    EXPECT_TRUE(pair(matrix, 0, 2).proved && pair(matrix, 0, 3).proved);
}

TEST(SelfCollision, TwoMovingJointsWithoutGeometryInBetweenAreNotAdjacent) {
    const SelfCollisionMatrix matrix = Builder()
                                           .link("a", {{{0, 0, 0}, 0.1}})
                                           .link("cross")
                                           .link("b", {{{0.3, 0, 0}, 0.1}, {{0.15, 0, 0}, 0.1}})
                                           .joint(turns, "a", "cross", {}, -1, 1, {0, 1, 0})
                                           .joint(turns, "cross", "b", {}, -1, 1)
                                           .matrix();
    EXPECT_EQ(pair(matrix, 0, 2).reason, PairReason::always);
    EXPECT_TRUE(pair(matrix, 0, 2).proved);
}

/// Fingers side by side, 0.3 m apart as long as they go together.
Builder fingers() {
    return Builder()
        .link("palm", {{{0, 0, 0}, 0.01}})
        .link("left_mount", {{{0, 0, 0}, 0.01}})
        .link("right_mount", {{{0, 0, 0}, 0.01}})
        .link("left", {{{0, 0, 0}, 0.1}})
        .link("right", {{{0, 0.3, 0}, 0.1}})
        .joint(fixed, "palm", "left_mount", {5, 0, 0})
        .joint(fixed, "palm", "right_mount", {5, 0, 0})
        .joint(slides, "left_mount", "left", {}, -1, 1, {0, 1, 0})
        .joint(slides, "right_mount", "right", {}, -1, 1, {0, 1, 0});
}

TEST(SelfCollision, MimicJointsGoTogether) {
    const LinkPair together = pair(fingers().mimic("left_mount_left").matrix(), 3, 4);
    EXPECT_EQ(together.reason, PairReason::never);
    EXPECT_TRUE(together.proved);
    const LinkPair alone = pair(fingers().matrix(), 3, 4);
    EXPECT_EQ(alone.reason, PairReason::none);
    EXPECT_GT(alone.touching, 0u);
}

TEST(SelfCollision, NothingIsKnownAcrossAFloatingJoint) {
    const SelfCollisionMatrix matrix = Builder()
                                           .link("a", {{{0, 0, 0}, 0.1}})
                                           .link("b", {{{0, 0, 0}, 0.1}})
                                           .link("c", {{{0, 0, 0}, 0.1}})
                                           .joint(Joint::Kind::floating, "a", "b", {1, 0, 0})
                                           .joint(fixed, "b", "c", {1, 0, 0})
                                           .matrix();
    EXPECT_EQ(pair(matrix, 0, 2).reason, PairReason::none);
    EXPECT_TRUE(pair(matrix, 0, 2).unbounded);
    EXPECT_EQ(pair(matrix, 0, 2).samples, 0u);
    const LinkPair hinged = pair(Builder()
                                     .link("a", {{{0, 0, 0}, 0.1}})
                                     .link("b", {{{0, 0, 0}, 0.1}})
                                     .link("c", {{{0, 0, 0}, 0.1}})
                                     .joint(Joint::Kind::planar, "a", "b", {1, 0, 0})
                                     .joint(turns, "b", "c", {1, 0, 0}, -1, 1)
                                     .matrix(),
                                 0, 2);
    EXPECT_EQ(hinged.reason, PairReason::none);
    EXPECT_EQ(hinged.samples, 0u) << "samples do not move the planar joint";
    CollisionModel model = Builder()
                               .link("a", {{{0, 0, 0}, 0.1}})
                               .link("b", {{{9, 0, 0}, 0.1}})
                               .link("c", {{{0, 0, 0}, 0.1}})
                               .joint(Joint::Kind::floating, "a", "b")
                               .joint(fixed, "b", "c")
                               .model();
    model.solids = solids_of_spheres(model);
    const SelfCollisionMatrix by_pose = self_collision_matrix(Kinematics(model.robot), model, {.by_pose = true});
    EXPECT_EQ(pair(by_pose, 0, 2).reason, PairReason::none) << "in the reference pose they touch";
}

/// A chain with axes, limits and spheres at random; every second one is so short that some links always touch.
Builder random_robot(std::uint64_t seed) {
    Random random(seed);
    const double spread = seed % 2 == 0 ? 1 : 0.1;
    const auto vector = [&](double size) {
        const auto coordinate = [&] { return spread * random.uniform(-size, size); };
        const double x = coordinate(), y = coordinate(), z = coordinate();
        return Vec3{x, y, z};
    };
    Builder builder;
    for (int i = 0; i < 4; ++i) {
        std::vector<Sphere> spheres;
        for (int k = 0; k < 3; ++k) {
            spheres.push_back({vector(0.2), random.uniform(0.02, 0.1)});
        }
        builder.link(std::string(1, static_cast<char>('a' + i)), spheres);
    }
    for (int i = 0; i < 3; ++i) {
        const double middle = random.uniform(-2, 2), half = random.uniform(0, 1.5);
        builder.joint(random.uniform() < 0.3 ? slides : turns, std::string(1, static_cast<char>('a' + i)),
                      std::string(1, static_cast<char>('b' + i)), vector(0.3), middle - half, middle + half, vector(1));
    }
    return builder;
}

TEST(SelfCollision, ProofsAgreeWithSamples) {
    std::size_t never = 0, always = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Builder builder = random_robot(seed);
        const SelfCollisionMatrix proofs = builder.matrix({.samples = 0, .proof_boxes = 5000});
        const SelfCollisionMatrix samples = builder.matrix({.samples = 3000, .seed = seed, .proof_boxes = 0});
        for (std::size_t i = 0; i < proofs.pairs.size(); ++i) {
            if (!proofs.pairs[i].proved) {
                continue;
            }
            const bool touching = proofs.pairs[i].reason == PairReason::always;
            (touching ? always : never) += 1;
            EXPECT_EQ(samples.pairs[i].touching, touching ? 3000u : 0u) << "seed " << seed << ", pair " << i;
        }
    }
    EXPECT_GE(never, 20u); // else this test says little
    EXPECT_GE(always, 1u);
}

TEST(SelfCollision, TheSameOnAnyNumberOfThreads) {
    const auto touching = [](std::size_t threads) {
        const ThreadLimit limit(threads);
        std::vector<std::size_t> counts;
        for (const LinkPair& p : random_robot(3).matrix({.samples = 5000, .seed = 9, .proof_boxes = 0}).pairs) {
            counts.push_back(p.touching);
        }
        return counts;
    };
    EXPECT_EQ(touching(1), touching(4));
}

TEST(SelfCollision, CancellationIsAnError) {
    const std::atomic<bool> cancel = true;
    try {
        arm(-1, 1).matrix({.cancel = &cancel});
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::cancelled);
    }
}

TEST(SelfCollision, AFlagThatIsNotSetChangesNothing) {
    const std::atomic<bool> cancel = false;
    const SelfCollisionMatrix matrix = arm(-1, 1).matrix({.cancel = &cancel});
    EXPECT_TRUE(pair(matrix, 0, 3).proved);
    const LinkPair searched =
        pair(arm(0, touches_from + 3e-5).matrix({.samples = 2000, .proof_boxes = 0, .cancel = &cancel}), 0, 3);
    EXPECT_TRUE(searched.found_touching);
}

TEST(SelfCollision, ThePoseChangesNoOtherReason) {
    const auto matrix = [](double elbow_from) {
        Builder builder = Builder()
                              .link("a", {{{0, 0, 0}, 0.1}})
                              .link("b", {{{0.15, 0, 0}, 0.1}})
                              .link("c", {{{0, 0, 0}, 0.1}})
                              .joint(turns, "a", "b", {}, -3, 3)
                              .joint(turns, "b", "c", {elbow_from, 0, 0}, -3, 3);
        return matrix_of(model_with_geometry(builder, 1, CollisionModel::Source::geometry), {.samples = 500, .by_pose = true});
    };
    EXPECT_EQ(pair(matrix(0.15), 0, 1).reason, PairReason::adjacent);
    EXPECT_EQ(pair(matrix(0.15), 0, 2).reason, PairReason::always);
    EXPECT_EQ(pair(matrix(0.25), 0, 2).reason, PairReason::never);
}

TEST(SelfCollision, FilesOfOthers) {
    const Builder builder = Builder()
                                .link("a&b", {{{0, 0, 0}, 0.1}})
                                .link("c", {{{0, 0, 0}, 0.1}})
                                .link("d", {{{0, 0, 0}, 0.1}})
                                .joint(fixed, "a&b", "c")
                                .joint(turns, "c", "d", {0.15, 0, 0}, -4, 4);
    const CollisionModel model = builder.model();
    const SelfCollisionMatrix matrix = builder.matrix();
    EXPECT_EQ(srdf_text(*model.robot, matrix),
              "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
              "<robot name=\"made\">\n"
              "  <disable_collisions link1=\"a&amp;b\" link2=\"c\" reason=\"Adjacent\"/>\n"
              "  <disable_collisions link1=\"a&amp;b\" link2=\"d\" reason=\"Always\"/>\n"
              "  <disable_collisions link1=\"c\" link2=\"d\" reason=\"Adjacent\"/>\n"
              "</robot>\n");
    EXPECT_EQ(curobo_text(*model.robot, matrix), "self_collision_ignore:\n"
                                                 "  \"a&b\": [\"c\", \"d\"]\n"
                                                 "  \"c\": [\"d\"]\n");
    EXPECT_EQ(curobo_text(*model.robot, {}), "self_collision_ignore: {}\n");
}

TEST(SelfCollision, AskingForNonsenseIsRefused) {
    const auto refused = [](const CollisionModel& model, double confidence) {
        try {
            matrix_of(model, {.samples = 10, .confidence = confidence});
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return std::string(error.what());
        }
        return std::string();
    };
    CollisionModel model = arm(-1, 1).model();
    for (const double confidence : {-0.5, 0.0, 1.0, 1.5, std::nan("")}) {
        EXPECT_THAT(refused(model, confidence), ::testing::HasSubstr("must lie between 0 and 1"));
    }
    EXPECT_EQ(refused(model, 1e-6) + refused(model, 1 - 1e-6), "");
    model.elements.pop_back();
    EXPECT_EQ(refused(model, 0.5), "spheres are given for 3 links, the robot has 4");
}

} // namespace
} // namespace foam::test
