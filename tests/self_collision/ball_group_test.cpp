// Whether the elements of two links touch: against all pairs of them.
#include "collision/src/link_shapes.hpp"
#include "geometry/plain_shapes.hpp"

#include <foam/collision/separation.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

using collision::self_collision::BallGroup;

struct SomeElements {
    std::vector<Sphere> spheres;
    std::vector<Element> others;

    SomeElements(Random& random, std::size_t balls, std::size_t bars) {
        const Box around{{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}};
        for (std::size_t i = 0; i < balls; ++i) {
            spheres.push_back({test::random_point(random, around), random.uniform(0.05, 0.3)});
        }
        for (std::size_t i = 0; i < bars; ++i) {
            Element bar{.kind = i % 2 ? Element::Kind::capsule : Element::Kind::box};
            bar.half = bar.kind == Element::Kind::box ? Vec3{0.1, 0.2, 0.4} : Vec3{0, 0, 0.4};
            bar.radius = bar.kind == Element::Kind::box ? 0 : 0.1;
            bar.pose = test::random_pose(random, 0.5);
            others.push_back(bar);
        }
    }
    std::vector<Element> all() const {
        std::vector<Element> elements = others;
        for (const Sphere& sphere : spheres) {
            elements.push_back(element_of(sphere));
        }
        return elements;
    }
    BallGroup group() const { return BallGroup(Elements{spheres, others}); }
};

TEST(BallGroup, TouchesAnotherAsOneOfItsElementsDoes) {
    Random random(2);
    int touching = 0, apart = 0;
    for (int round = 0; round < 1500; ++round) {
        const std::size_t kind = static_cast<std::size_t>(round % 8 + 1); // each has spheres, others, or both
        const SomeElements a(random, kind % 3, kind % 3 == 0 || kind > 5 ? 1 + kind % 2 : 0),
            b(random, (kind + 1) % 3, (kind + 1) % 3 == 0 || kind > 3 ? 2 : 0);
        const Pose pose_a = test::random_pose(random, 0.3), pose_b = test::random_pose(random, 0.3);
        bool expected = false;
        for (const Element& e : a.all()) {
            for (const Element& f : b.all()) {
                expected = expected || separation(e, f, pose_a, pose_b).low == 0;
            }
        }
        EXPECT_EQ(touch(a.group(), pose_a, b.group(), pose_b), expected) << round;
        (expected ? touching : apart) += 1;
    }
    EXPECT_GT(touching, 300);
    EXPECT_GT(apart, 300);
}

TEST(BallGroup, SpheresThatMeetInAPointTouch) {
    const std::vector<Sphere> one{{{}, 1}}, other{{{3, 0, 0}, 2}}, near{{{3.001, 0, 0}, 2}};
    const auto group = [](const std::vector<Sphere>& spheres) { return BallGroup(Elements(spheres)); };
    EXPECT_TRUE(touch(group(one), {}, group(other), {}));
    EXPECT_FALSE(touch(group(one), {}, group(near), {}));
    EXPECT_FALSE(shaped_touch(group(one), {}, group(other), {})) << "of pairs with an element that is no sphere";
}

} // namespace
} // namespace foam
