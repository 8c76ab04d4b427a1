// The self-collision matrix of robots whose answer is known, and what it promises of any robot.
#include <foam/base/error.hpp>
#include <foam/base/parallel.hpp>
#include <foam/collision/self_collision.hpp>
#include <foam/judge/evaluate.hpp>

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>

namespace foam::test {
namespace {

using std::numbers::pi;
using ::testing::ElementsAre;

/// Links and joints one by one; a joint without limits given turns or slides by them.
class Builder {
public:
    Builder& link(const std::string& name, std::vector<Sphere> spheres = {}) {
        robot_.links.push_back({.name = name, .collisions = {}, .visuals = {}});
        elements_.push_back(std::move(spheres));
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
    /// Makes the last joint follow another.
    Builder& mimic(const std::string& joint) {
        robot_.joints.back().mimic = Mimic{.joint = joint};
        return *this;
    }
    CollisionModel model() const {
        Robot robot = robot_;
        robot.name = "made";
        robot.root = robot.links.front().name;
        return {std::make_shared<const Robot>(robot),
                elements_,
                std::vector<CollisionModel::Source>(elements_.size(), CollisionModel::Source::geometry),
                {}};
    }
    SelfCollisionMatrix matrix(const SelfCollisionOptions& options = {}) const {
        const CollisionModel made = model();
        return self_collision_matrix(Kinematics(made.robot), made, options);
    }

private:
    Robot robot_;
    std::vector<Elements> elements_;
};

/// Returns the spheres as original geometry.
LinkSolids solids_of_spheres(const CollisionModel& model) {
    LinkSolids solids;
    for (const Elements& elements : model.elements) {
        std::vector<Solid::Part> parts;
        for (const Sphere& sphere : elements.spheres()) {
            parts.push_back({nullptr, Element::sphere(sphere.radius), Pose::from_xyz_rpy(sphere.center, {})});
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

/// A model whose geometry are its spheres with a share of their radii.
CollisionModel model_with_geometry(const Builder& builder, double share, CollisionModel::Source source) {
    CollisionModel model = builder.model();
    model.sources.assign(model.sources.size(), source);
    CollisionModel small = model;
    for (Elements& elements : small.elements) {
        for (Sphere& sphere : elements.spheres()) {
            sphere.radius *= share;
        }
    }
    model.solids = solids_of_spheres(small);
    return model;
}

SelfCollisionMatrix matrix_of(const CollisionModel& model, const SelfCollisionOptions& options = {}) {
    return self_collision_matrix(Kinematics(model.robot), model, options);
}

/// The base and the hand of an arm that always touch by their spheres, with geometry of a tenth of the radius or more.
LinkPair with_geometry(double share, CollisionModel::Source source, double lower = 3, double upper = 3.1,
                       std::size_t samples = 3000) {
    return pair(matrix_of(model_with_geometry(arm(lower, upper), share, source), {.samples = samples}), 0, 3);
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

TEST(SelfCollision, LinksThatAreJoinedStaySoWhateverTheirGeometryDoes) {
    for (const double share : {0.5, 8.0}) {
        const CollisionModel model = model_with_geometry(arm(-1, 1), share, CollisionModel::Source::given);
        const LinkPair joined = pair(matrix_of(model, {.samples = 1000}), 0, 1);
        EXPECT_EQ(joined.reason, PairReason::adjacent);
        EXPECT_EQ(joined.geometry_samples, 0u);
    }
}

TEST(SelfCollision, AlwaysIsSaidOfLimitsToo) {
    // Apart in less of the range than samples meet: at one limit, or at zero.
    const auto reason = [](double lower, double upper) {
        return pair(arm(lower, upper).matrix({.samples = 500, .proof_boxes = 0}), 0, 3).reason;
    };
    EXPECT_EQ(reason(touches_from - 1e-7, pi), PairReason::none);
    EXPECT_EQ(reason(-pi, -touches_from + 1e-7), PairReason::none);
    EXPECT_EQ(reason(touches_from + 1e-7, pi), PairReason::always);
    EXPECT_EQ(reason(-pi, -touches_from - 1e-7), PairReason::always);
    const auto at_pose = [](double elbow) {
        return pair(arm(touches_from, pi).matrix({.samples = 500, .proof_boxes = 0, .reference = {{"upper_lower", elbow}}}),
                    0, 3)
            .reason;
    };
    EXPECT_EQ(at_pose(pi), PairReason::always);
}

TEST(SelfCollision, ACornerOfTheLimitsIsLookedAt) {
    // Two sliders: the links are apart where both are at one limit, in a millionth of a millionth of the range.
    for (int corner = 0; corner < 4; ++corner) {
        const double x = corner & 1 ? 1 : -1, y = corner & 2 ? 1 : -1;
        const double far = std::sqrt(2.0) * 0.1 - 1e-7; // of the corner from the middle, but for a little
        const Builder builder = Builder()
                                    .link("base", {{{0, 0, 0}, far / 2}})
                                    .link("between")
                                    .link("hand", {{{0, 0, 0}, far / 2}})
                                    .joint(slides, "base", "between", {}, x > 0 ? 0 : -0.1, x > 0 ? 0.1 : 0, {1, 0, 0})
                                    .joint(slides, "between", "hand", {}, y > 0 ? 0 : -0.1, y > 0 ? 0.1 : 0, {0, 1, 0});
        const LinkPair hand = pair(builder.matrix({.samples = 500, .proof_boxes = 0}), 0, 2);
        EXPECT_EQ(hand.touching, 500u);
        EXPECT_EQ(hand.reason, PairReason::none) << corner;
    }
}

TEST(SelfCollision, AProofOfElementsThatLeaveGeometryOutIsNone) {
    using Source = CollisionModel::Source;
    const LinkPair given = with_geometry(0.99, Source::given, -1, 1), cover = with_geometry(0.99, Source::cover, -1, 1);
    EXPECT_FALSE(given.proved);
    EXPECT_EQ(given.geometry_samples, 3000u);
    EXPECT_EQ(given.geometry_touching, 0u);
    EXPECT_TRUE(cover.proved);
    EXPECT_EQ(cover.geometry_samples, 0u);
    CollisionModel mixed = arm(-1, 1).model();
    mixed.solids = solids_of_spheres(mixed);
    for (const std::size_t one : {0u, 3u}) { // one of the two is enough
        mixed.sources.assign(mixed.sources.size(), Source::cover);
        mixed.sources[one] = Source::given;
        EXPECT_FALSE(pair(self_collision_matrix(Kinematics(mixed.robot), mixed, {.samples = 2000}), 0, 3).proved);
    }
    mixed.solids[3] = nullptr; // there is no geometry to be left out
    EXPECT_TRUE(pair(self_collision_matrix(Kinematics(mixed.robot), mixed, {.samples = 2000}), 0, 3).proved);
}

TEST(SelfCollision, TheBoundIsOfThePairWithTheFewestConfigurations) {
    SelfCollisionMatrix matrix = arm(-1, 1).matrix({.samples = 1000, .proof_boxes = 0});
    LinkPair never = pair(matrix, 0, 3);
    never.geometry_samples = 10;
    matrix.pairs.push_back(never);
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 10), 0.05, 1e-12);
    EXPECT_NEAR(std::pow(1 - matrix.joint_rate_bound(), 10), 0.025, 1e-12);
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(7), 7), 0.05, 1e-12);
    matrix.pairs.back().proved = true;
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12) << "what is proved needs none";
    matrix.pairs.back().proved = false;
    matrix.pairs.back().reason = PairReason::always;
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12);
    EXPECT_EQ(matrix.count(PairReason::always), 1u);
    EXPECT_EQ(matrix.count(PairReason::adjacent), 2u);
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

TEST(SelfCollision, WhatIsJoinedOrProvedTakesNoSamples) {
    for (const LinkPair& each : arm(-1, 1).matrix().pairs) {
        EXPECT_NE(each.reason, PairReason::none);
        EXPECT_EQ(each.samples, 0u);
    }
    const LinkPair always = pair(arm(3, 3.1).matrix(), 0, 3);
    EXPECT_TRUE(always.proved);
    EXPECT_EQ(always.samples + always.touching, 0u);
    // Of elements around the geometry: as many as there are before the proof.
    EXPECT_EQ(with_geometry(0.99, CollisionModel::Source::cover, 3, 3.1, 20'000).samples, 2048u);
}

TEST(SelfCollision, SamplesGoOnUntilTheRateIsKnown) {
    // Until a hundred are seen of both, after two blocks of 1024 and from then on after each eight.
    const auto samples = [](double rate) {
        const LinkPair rare = pair(arm(0, touches_from / (1 - rate)).matrix({.samples = 20'000, .proof_boxes = 0}), 0, 3),
                       often = pair(arm(touches_from - rate / (1 - rate) * (pi - touches_from), pi)
                                        .matrix({.samples = 20'000, .proof_boxes = 0}), 0, 3);
        EXPECT_NEAR(static_cast<double>(rare.touching), rate * static_cast<double>(rare.samples), 50);
        EXPECT_NEAR(static_cast<double>(often.touching), (1 - rate) * static_cast<double>(often.samples), 50);
        EXPECT_EQ(rare.reason, PairReason::none);
        EXPECT_EQ(often.reason, PairReason::none);
        return std::pair(rare.samples, often.samples);
    };
    EXPECT_EQ(samples(0.1), std::pair(std::size_t{2048}, std::size_t{2048}));
    EXPECT_EQ(samples(0.036), std::pair(std::size_t{10'240}, std::size_t{10'240}));
    EXPECT_EQ(samples(0.017), std::pair(std::size_t{10'240}, std::size_t{10'240}));
    EXPECT_EQ(samples(0.001), std::pair(std::size_t{20'000}, std::size_t{20'000}));
}

TEST(SelfCollision, NoSampleIsNoReasonAndOneIsOne) {
    const auto never = [](std::size_t samples) {
        return pair(arm(-1, 1).matrix({.samples = samples, .proof_boxes = 0}), 0, 3).reason;
    };
    EXPECT_EQ(never(0), PairReason::none);
    EXPECT_EQ(never(1), PairReason::never);
}

TEST(SelfCollision, ElementsThatLeaveGeometryOutProveNothingOfItWithoutSamples) {
    const LinkPair untested = with_geometry(8, CollisionModel::Source::given, -1, 1, 0);
    EXPECT_EQ(untested.reason, PairReason::none) << "the geometry touches";
    EXPECT_FALSE(untested.proved);
    EXPECT_EQ(with_geometry(0.5, CollisionModel::Source::cover, -1, 1, 0).reason, PairReason::never);
}

TEST(SelfCollision, AFlagThatIsNotSetChangesNothing) {
    const std::atomic<bool> cancel = false;
    const SelfCollisionMatrix matrix = arm(-1, 1).matrix({.cancel = &cancel});
    EXPECT_TRUE(pair(matrix, 0, 3).proved);
    const LinkPair searched =
        pair(arm(0, touches_from + 3e-5).matrix({.samples = 2000, .proof_boxes = 0, .cancel = &cancel}), 0, 3);
    EXPECT_TRUE(searched.found_touching);
}

TEST(SelfCollision, ToldHowMuchIsDone) {
    std::vector<double> shares;
    const auto keep = [&](double share) { shares.push_back(share); };
    arm(0, touches_from + 1e-3).matrix({.samples = 26 * 1024, .proof_boxes = 0, .progress = keep});
    EXPECT_EQ(shares.size(), 2u + 3u + 1u) << "after the first samples, the proofs, each eight blocks, and all";
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GT(shares.front(), 0);
    EXPECT_EQ(std::set<double>(shares.begin(), shares.end()).size(), shares.size()) << "each more than the last";
    EXPECT_EQ(shares.back(), 1);
}

TEST(SelfCollision, HowOftenTheGeometryIsTested) {
    using Source = CollisionModel::Source;
    // All samples where it is always the same, at most ten blocks; else until the first block tells.
    EXPECT_EQ(with_geometry(0.99, Source::cover).geometry_samples, 3000u);
    EXPECT_EQ(with_geometry(0.01, Source::cover).geometry_samples, 3000u);
    EXPECT_EQ(with_geometry(0.99, Source::cover, 3, 3.1, 20'000).geometry_samples, 10'240u);
    EXPECT_EQ(with_geometry(8, Source::given, -1, 1).geometry_samples, 1024u);
    EXPECT_EQ(with_geometry(8, Source::given, -1, 1).geometry_touching, 1024u);
    // Apart at all limits, but not in between.
    const LinkPair middle = with_geometry(0.1, Source::cover, pi - 0.1, pi + 0.1);
    EXPECT_EQ(middle.reason, PairReason::none);
    EXPECT_EQ(middle.geometry_samples, 1024u);
    EXPECT_TRUE(middle.touches_by_elements_alone);
    // Of the reference pose, zero and the four corners of the limits it touches where the elbow is at the upper one.
    const LinkPair special = with_geometry(0.1, Source::cover);
    EXPECT_EQ(special.geometry_samples, 6u);
    EXPECT_EQ(special.geometry_touching, 2u);
    EXPECT_FALSE(with_geometry(0.01, Source::cover).touches_by_elements_alone);
}

TEST(SelfCollision, OneContactOfTheGeometryIsEnough) {
    // The share of the radii with which the geometry touches in a single sample of all.
    const auto expect_checked = [](CollisionModel::Source source, double lower, double upper, double apart, double touching) {
        LinkPair found;
        for (int step = 0; step < 60 && found.geometry_touching != 1; ++step) {
            const double middle = (apart + touching) / 2;
            found = with_geometry(middle, source, lower, upper, 1000);
            (found.geometry_touching == 0 ? apart : touching) = middle;
        }
        EXPECT_EQ(found.geometry_touching, 1u);
        EXPECT_EQ(found.geometry_samples, 1000u);
        EXPECT_EQ(found.reason, PairReason::none);
        return found.touches_by_elements_alone;
    };
    EXPECT_FALSE(expect_checked(CollisionModel::Source::given, -1, 1, 1, 8));
    EXPECT_TRUE(expect_checked(CollisionModel::Source::cover, pi - 0.1, pi + 0.1, 1e-5, 0.2));
}

TEST(SelfCollision, ElementsThatAreTheGeometryOfBothLinksAlone) {
    using Source = CollisionModel::Source;
    CollisionModel model = model_with_geometry(arm(3, 3.1), 0.01, Source::geometry);
    EXPECT_TRUE(pair(matrix_of(model), 0, 3).proved); // elements that are the geometry speak for it
    for (const std::size_t other : {0u, 3u}) {
        model.sources.assign(4, Source::geometry);
        model.sources[other] = Source::cover;
        const LinkPair hand = pair(matrix_of(model, {.samples = 2000}), 0, 3);
        EXPECT_EQ(hand.reason, PairReason::never) << "the geometry is apart";
        EXPECT_FALSE(hand.proved);
        EXPECT_EQ(hand.geometry_samples, 2000u);
    }
    const LinkPair apart = pair(matrix_of(model_with_geometry(arm(-1, 1), 0.5, Source::geometry)), 0, 3);
    EXPECT_TRUE(apart.proved);
    EXPECT_EQ(apart.geometry_samples, 0u);
}

TEST(SelfCollision, UnknownGeometryOfOneLinkLeavesThePairToBeChecked) {
    for (const bool rigid : {false, true}) {
        const Builder builder = rigid ? Builder()
                                            .link("a", {{{0, 0, 0}, 0.2}})
                                            .link("b", {{{0, 0, 0}, 0.01}})
                                            .link("c")
                                            .link("d", {{{0, 0, 0}, 0.2}})
                                            .joint(fixed, "a", "b", {0.15, 0, 0})
                                            .joint(fixed, "b", "c", {0.1, 0, 0})
                                            .joint(fixed, "c", "d", {0.05, 0, 0})
                                      : arm(3, 3.1);
        for (const std::size_t unknown : {0u, 3u}) {
            CollisionModel model = model_with_geometry(builder, 0.1, CollisionModel::Source::cover);
            EXPECT_NE(pair(matrix_of(model, {.samples = 1000}), 0, 3).geometry_samples, 0u);
            model.solids[unknown] = nullptr;
            const LinkPair hand = pair(matrix_of(model, {.samples = 1000}), 0, 3);
            EXPECT_EQ(hand.reason, PairReason::none) << rigid << unknown;
            EXPECT_EQ(hand.geometry_samples, 0u);
            EXPECT_FALSE(hand.touches_by_elements_alone);
        }
    }
}

TEST(SelfCollision, SixJointsAreSetToTheirLimitsAtOnce) {
    // Links that are apart only where each of six sliders is at its upper limit.
    Builder builder;
    builder.link("l0", {{{0, 0, 0}, 0.3 - 1e-6}});
    for (int i = 0; i < 6; ++i) {
        const std::string number = std::to_string(i), next = std::to_string(i + 1);
        builder.link("l" + next, i == 5 ? std::vector<Sphere>{{{0, 0, 0}, 0.3 - 1e-6}} : std::vector<Sphere>{});
        builder.joint(slides, "l" + number, "l" + next, {}, 0, 0.1, {1, 0, 0});
    }
    const LinkPair ends = pair(builder.matrix({.samples = 500, .proof_boxes = 0}), 0, 6);
    EXPECT_EQ(ends.touching, 500u);
    EXPECT_EQ(ends.reason, PairReason::none);
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

TEST(SelfCollision, TheBoundWhereNothingOrOneConfigurationWasTested) {
    SelfCollisionMatrix matrix = arm(-1, 1).matrix({.samples = 1000});
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12); // of pairs that are not there
    EXPECT_EQ(matrix.joint_rate_bound(), matrix.rate_bound());
    matrix.pairs.push_back({.first = 0, .second = 3, .reason = PairReason::never});
    matrix.pairs.back().geometry_samples = 1;
    EXPECT_NEAR(matrix.rate_bound(), 0.95, 1e-12);
    EXPECT_NEAR(matrix.joint_rate_bound(), 0.95, 1e-12);
}

} // namespace
} // namespace foam::test
