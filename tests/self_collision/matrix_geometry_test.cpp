// The self-collision matrix where elements are not the original geometry: what is said of the geometry, and how it is tested.
#include "made_robot.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace foam::test {
namespace {

using std::numbers::pi;

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

TEST(SelfCollision, ElementsThatLeaveGeometryOutProveNothingOfItWithoutSamples) {
    const LinkPair untested = with_geometry(8, CollisionModel::Source::given, -1, 1, 0);
    EXPECT_EQ(untested.reason, PairReason::none) << "the geometry touches";
    EXPECT_FALSE(untested.proved);
    EXPECT_EQ(with_geometry(0.5, CollisionModel::Source::cover, -1, 1, 0).reason, PairReason::never);
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

} // namespace
} // namespace foam::test
