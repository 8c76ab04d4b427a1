// The self-collision matrix by samples: rates and their bounds, how many are taken, and what samples miss.
#include "made_robot.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace foam::test {
namespace {

using std::numbers::pi;

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

TEST(SelfCollision, NoSampleIsNoReasonAndOneIsOne) {
    const auto never = [](std::size_t samples) {
        return pair(arm(-1, 1).matrix({.samples = samples, .proof_boxes = 0}), 0, 3).reason;
    };
    EXPECT_EQ(never(0), PairReason::none);
    EXPECT_EQ(never(1), PairReason::never);
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

TEST(SelfCollision, ASearchFindsContactsThatSamplesMiss) {
    // They touch in a hundred-thousandth of the range.
    const LinkPair hand = pair(arm(0, touches_from + 3e-5).matrix({.samples = 2000, .proof_boxes = 0}), 0, 3);
    EXPECT_EQ(hand.touching, 0u);
    EXPECT_TRUE(hand.found_touching);
    EXPECT_EQ(hand.reason, PairReason::none);
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

TEST(SelfCollision, TheBoundIsThatOfZeroSuccesses) {
    SelfCollisionMatrix matrix = arm(-1, 1).matrix({.samples = 1000, .proof_boxes = 0});
    // (1 - bound)^n = 1 - c.
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12);
    EXPECT_NEAR(matrix.rate_bound(), 3.0 / 1000, 1e-5);
    EXPECT_EQ(matrix.joint_rate_bound(), matrix.rate_bound()); // of a single pair
    matrix.pairs.push_back(pair(matrix, 0, 3));
    EXPECT_NEAR(std::pow(1 - matrix.joint_rate_bound(), 1000), 0.025, 1e-12);
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

TEST(SelfCollision, TheBoundWhereNothingOrOneConfigurationWasTested) {
    SelfCollisionMatrix matrix = arm(-1, 1).matrix({.samples = 1000});
    EXPECT_NEAR(std::pow(1 - matrix.rate_bound(), 1000), 0.05, 1e-12); // of pairs that are not there
    EXPECT_EQ(matrix.joint_rate_bound(), matrix.rate_bound());
    matrix.pairs.push_back({.first = 0, .second = 3, .reason = PairReason::never});
    matrix.pairs.back().geometry_samples = 1;
    EXPECT_NEAR(matrix.rate_bound(), 0.95, 1e-12);
    EXPECT_NEAR(matrix.joint_rate_bound(), 0.95, 1e-12);
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

} // namespace
} // namespace foam::test
