// Whether links of primitives touch: against all pairs of these.
#include "geometry/plain_shapes.hpp"
#include "row_of_links.hpp"

#include <foam/collision/consequences.hpp>
#include <foam/collision/separation.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

constexpr auto slides = Joint::Kind::prismatic;

/// Returns whether two links touch, the second one at a place: pairs that touch in every configuration are not checked,
/// and these joints do not move.
bool touch(const std::vector<Solid::Part>& a, const std::vector<Solid::Part>& b, const Vec3& place) {
    const test::Arm arm{{{slides, place, {1, 0, 0}, 0, 0}, {slides, {}, {1, 0, 0}, 0, 0}}};
    const Kinematics kinematics(arm.robot());
    LinkSolids solids(kinematics.robot().links.size());
    solids.front() = Solid::make(a);
    solids.back() = Solid::make(b);
    const CollisionModel model{
        .robot = arm.robot(), .elements = std::vector<Elements>(solids.size()), .sources = {}, .notes = {}};
    return consequences_of(kinematics, model, solids, {}, {}).pairs.empty();
}

std::vector<Solid::Part> some_parts(Random& random, std::size_t balls, std::size_t bars, const Pose& pose) {
    std::vector<Solid::Part> parts;
    for (std::size_t i = 0; i < bars; ++i) {
        const Element bar = i % 2 ? Element::capsule(0.1, 0.8) : Element::box({0.2, 0.4, 0.8});
        parts.push_back({nullptr, bar, pose * test::random_pose(random, 0.5)});
    }
    for (std::size_t i = 0; i < balls; ++i) {
        Pose at;
        at.translation = pose * test::random_vector(random, 0.5);
        parts.push_back({nullptr, Element::sphere(random.uniform(0.05, 0.3)), at});
    }
    return parts;
}

TEST(TouchingLinks, TouchAsOneOfTheirPrimitivesDoes) {
    Random random(2);
    int touching = 0, apart = 0;
    for (int round = 0; round < 1500; ++round) {
        const std::size_t kind = static_cast<std::size_t>(round % 8 + 1); // each has spheres, others, or both
        const Pose pose_a = test::random_pose(random, 0.3), pose_b = test::random_pose(random, 0.3);
        const std::vector<Solid::Part> a = some_parts(random, kind % 3, kind % 3 == 0 || kind > 5 ? 1 + kind % 2 : 0,
                                                      pose_a),
                                       b = some_parts(random, (kind + 1) % 3, (kind + 1) % 3 == 0 || kind > 3 ? 2 : 0,
                                                      pose_b);
        Pose place;
        place.translation = test::random_vector(random, 0.3);
        bool expected = false;
        for (const Solid::Part& e : a) {
            for (const Solid::Part& f : b) {
                expected = expected || separation(*e.primitive, *f.primitive, e.pose, place * f.pose).low == 0;
            }
        }
        EXPECT_EQ(touch(a, b, place.translation), expected) << round;
        (expected ? touching : apart) += 1;
    }
    EXPECT_GT(touching, 300);
    EXPECT_GT(apart, 300);
}

TEST(TouchingLinks, SpheresThatMeetInAPointTouch) {
    const auto ball = [](double radius) { return std::vector<Solid::Part>{{nullptr, Element::sphere(radius), {}}}; };
    EXPECT_TRUE(touch(ball(1), ball(2), {3, 0, 0}));
    EXPECT_FALSE(touch(ball(1), ball(2), {3.001, 0, 0}));
}

} // namespace
} // namespace foam
