// The self-collision matrix of robots whose answer is known, and what it promises of any robot.
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/judge/evaluate.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace foam::test {
namespace {

using std::numbers::pi;
using ::testing::ElementsAre;

/// Links and joints one by one; a joint without limits given turns or slides by them.
class Builder {
public:
    Builder& link(const std::string& name, std::vector<Sphere> spheres = {}) {
        robot_.links.push_back({.name = name, .collisions = {}, .visuals = {}});
        spheres_.push_back(std::move(spheres));
        return *this;
    }
    Builder& joint(Joint::Kind kind, const std::string& parent, const std::string& child, const Vec3& at = {},
                   double lower = 0, double upper = 0, const Vec3& axis = {0, 0, 1}) {
        robot_.joints.push_back({.name = parent + "_" + child,
                                 .kind = kind,
                                 .parent = parent,
                                 .child = child,
                                 .origin = Pose::from_xyz_rpy(at, {}),
                                 .axis = normalized(axis),
                                 .lower = lower,
                                 .upper = upper});
        return *this;
    }
    Builder& source(const std::string& text) {
        robot_.source = text;
        return *this;
    }
    CollisionModel model() const {
        Robot robot = robot_;
        robot.name = "made";
        robot.root = robot.links.front().name;
        return {std::make_shared<const Robot>(robot),
                spheres_,
                std::vector<CollisionModel::Source>(spheres_.size(), CollisionModel::Source::geometry),
                {}};
    }
    SelfCollisionMatrix matrix(const SelfCollisionOptions& options = {}) const {
        const CollisionModel made = model();
        return self_collision_matrix(Kinematics(made.robot), made, options);
    }

private:
    Robot robot_;
    std::vector<std::vector<Sphere>> spheres_;
};

/// Returns the spheres as original geometry.
LinkSolids solids_of_spheres(const CollisionModel& model) {
    LinkSolids solids;
    for (const std::vector<Sphere>& spheres : model.spheres) {
        std::vector<Solid::Part> parts;
        for (const Sphere& sphere : spheres) {
            parts.push_back({nullptr, Primitive{.radius = sphere.radius}, Pose::from_xyz_rpy(sphere.center, {})});
        }
        solids.push_back(parts.empty() ? nullptr : Solid::make(std::move(parts)));
    }
    return solids;
}

constexpr auto turns = Joint::Kind::revolute;
constexpr auto slides = Joint::Kind::prismatic;
constexpr auto fixed = Joint::Kind::fixed;

/// Two links of 1 m in a plane. The hand at the end is 2 |cos(elbow / 2)| from the base; they touch at 0.5 m.
Builder arm(double lower, double upper) {
    return Builder()
        .link("base", {{{0, 0, 0}, 0.3}})
        .link("upper", {{{0.5, 0, 0}, 0.05}})
        .link("lower")
        .link("hand", {{{0, 0, 0}, 0.2}})
        .joint(turns, "base", "upper", {}, -3, 3)
        .joint(turns, "upper", "lower", {1, 0, 0}, lower, upper)
        .joint(fixed, "lower", "hand", {1, 0, 0});
}

const double touches_from = 2 * std::acos(0.25); // of the elbow, to π

const LinkPair& pair(const SelfCollisionMatrix& matrix, std::size_t first, std::size_t second) {
    for (const LinkPair& candidate : matrix.pairs) {
        if (candidate.first == first && candidate.second == second) {
            return candidate;
        }
    }
    throw std::out_of_range("no such pair");
}

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

TEST(SelfCollision, TheRateOfTouchingPairs) {
    const SelfCollisionMatrix matrix = arm(-pi, pi).matrix();
    const LinkPair& hand = pair(matrix, 0, 3);
    EXPECT_EQ(hand.reason, PairReason::none);
    EXPECT_GE(hand.samples, 2048u); // further samples would only make the rate more exact
    const double rate = 1 - touches_from / pi, samples = static_cast<double>(hand.samples);
    const double error = std::sqrt(rate * (1 - rate) / samples);
    EXPECT_NEAR(static_cast<double>(hand.touching) / samples, rate, 5 * error);
}

TEST(SelfCollision, PairsThatTouchRarelyAreChecked) {
    // In 1e-3 of the range of the elbow, which 100 000 samples hit some 100 times.
    const double range = (touches_from - 0) / (1 - 1e-3);
    const LinkPair hand = pair(arm(0, range).matrix(), 0, 3);
    EXPECT_EQ(hand.reason, PairReason::none);
    EXPECT_NEAR(static_cast<double>(hand.touching), 100, 50);
}

TEST(SelfCollision, SamplesDecideWhereNothingIsProved) {
    const auto verdict = [](double lower, double upper, std::size_t samples) {
        return pair(arm(lower, upper).matrix({.samples = samples, .proof_boxes = 0}), 0, 3);
    };
    const LinkPair never = verdict(-1, 1, 500), always = verdict(3, 3.1, 500), unknown = verdict(-1, 1, 0);
    EXPECT_EQ(never.reason, PairReason::never);
    EXPECT_EQ(always.reason, PairReason::always);
    EXPECT_EQ(unknown.reason, PairReason::none);
    EXPECT_FALSE(never.proved || always.proved);
    EXPECT_EQ(never.samples, 500u);
    EXPECT_EQ(never.touching, 0u);
    EXPECT_EQ(always.touching, 500u);
}

TEST(SelfCollision, TheBoundIsThatOfZeroSuccesses) {
    SelfCollisionMatrix matrix = arm(-1, 1).matrix({.samples = 1000, .proof_boxes = 0});
    // (1 - bound)^n = 1 - c.
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12);
    EXPECT_NEAR(matrix.rate_bound(), 3.0 / 1000, 1e-5);
    EXPECT_EQ(matrix.joint_rate_bound(), matrix.rate_bound()); // of a single pair
    matrix.pairs.push_back(pair(matrix, 0, 3));
    EXPECT_NEAR(std::pow(1 - matrix.joint_rate_bound(), 1000), 0.025, 1e-12);
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

/// The base and the hand of an arm that always touch by their spheres, with geometry of a tenth of the radius or more.
LinkPair with_geometry(double share, CollisionModel::Source source, double lower = 3, double upper = 3.1) {
    CollisionModel model = arm(lower, upper).model();
    model.sources.assign(model.sources.size(), source);
    CollisionModel small = model;
    for (std::vector<Sphere>& spheres : small.spheres) {
        for (Sphere& sphere : spheres) {
            sphere.radius *= share;
        }
    }
    model.solids = solids_of_spheres(small);
    return pair(self_collision_matrix(Kinematics(model.robot), model, {.samples = 3000}), 0, 3);
}

TEST(SelfCollision, AlwaysIsSaidOfTheGeometryNotOfTheElements) {
    using Source = CollisionModel::Source;
    const LinkPair both = with_geometry(0.99, Source::cover);
    EXPECT_EQ(both.reason, PairReason::always);
    EXPECT_FALSE(both.proved); // of the geometry there are samples
    EXPECT_EQ(both.geometry_touching, both.geometry_samples);
    EXPECT_FALSE(both.touches_by_elements_alone);
    const LinkPair elements = with_geometry(0.1, Source::cover);
    EXPECT_EQ(elements.reason, PairReason::none);
    EXPECT_TRUE(elements.touches_by_elements_alone);
    EXPECT_GT(elements.geometry_touching, 0u); // at the end of the range
    const LinkPair none = with_geometry(0.01, Source::cover);
    EXPECT_EQ(none.reason, PairReason::never);
    EXPECT_EQ(none.touching, none.samples);
    EXPECT_EQ(none.geometry_touching, 0u);
    CollisionModel unknown = arm(3, 3.1).model();
    unknown.sources.assign(unknown.sources.size(), Source::cover);
    EXPECT_EQ(pair(self_collision_matrix(Kinematics(unknown.robot), unknown, {}), 0, 3).reason, PairReason::none);
}

TEST(SelfCollision, NeverIsSaidOfTheGeometryWhereElementsMayLeaveItOut) {
    using Source = CollisionModel::Source;
    EXPECT_EQ(with_geometry(8, Source::given, -1, 1).reason, PairReason::none);
    EXPECT_EQ(with_geometry(0.99, Source::given, -1, 1).reason, PairReason::never);
    EXPECT_EQ(with_geometry(0.99, Source::cover, -1, 1).reason, PairReason::never);
}

TEST(SelfCollision, ASearchFindsContactsThatSamplesMiss) {
    // They touch in a hundred-thousandth of the range.
    const LinkPair hand = pair(arm(0, touches_from + 3e-5).matrix({.samples = 2000, .proof_boxes = 0}), 0, 3);
    EXPECT_EQ(hand.touching, 0u);
    EXPECT_TRUE(hand.found_touching);
    EXPECT_EQ(hand.reason, PairReason::none);
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
        for (std::vector<Sphere>& spheres : small.spheres) {
            spheres.front().radius *= share;
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
Builder fingers(const std::string& source) {
    return Builder()
        .link("palm", {{{0, 0, 0}, 0.01}})
        .link("left_mount", {{{0, 0, 0}, 0.01}})
        .link("right_mount", {{{0, 0, 0}, 0.01}})
        .link("left", {{{0, 0, 0}, 0.1}})
        .link("right", {{{0, 0.3, 0}, 0.1}})
        .joint(fixed, "palm", "left_mount", {5, 0, 0})
        .joint(fixed, "palm", "right_mount", {5, 0, 0})
        .joint(slides, "left_mount", "left", {}, -1, 1, {0, 1, 0})
        .joint(slides, "right_mount", "right", {}, -1, 1, {0, 1, 0})
        .source(source);
}

TEST(SelfCollision, MimicJointsGoTogether) {
    const std::string mimic =
        "<robot name='made'><joint name='left_mount_left'><limit/></joint>"
        "<joint name='right_mount_right'><limit/><mimic joint='left_mount_left'/></joint></robot>";
    const LinkPair together = pair(fingers(mimic).matrix(), 3, 4);
    EXPECT_EQ(together.reason, PairReason::never);
    EXPECT_TRUE(together.proved);
    const LinkPair alone = pair(fingers("").matrix(), 3, 4);
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

} // namespace
} // namespace foam::test
