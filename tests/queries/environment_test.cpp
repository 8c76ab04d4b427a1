// Random environments: the same every time, within their bounds, clear of what does not move.
#include "bench/src/queries/environment.hpp"

#include <foam/base/error.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

/// A base, and an arm of 1 m along x that turns about z.
std::shared_ptr<const Robot> arm() {
    auto robot = std::make_shared<Robot>();
    robot->name = "arm";
    robot->root = "base";
    robot->links = {{"base", {}, {}}, {"plate", {}, {}}, {"arm", {}, {}}};
    Joint fixed;
    fixed.name = "fixed";
    fixed.parent = "base";
    fixed.child = "plate";
    fixed.origin.translation = {0, 0, 0.5};
    Joint turning;
    turning.name = "turning";
    turning.kind = Joint::Kind::continuous;
    turning.parent = "plate";
    turning.child = "arm";
    turning.axis = {0, 0, 1};
    robot->joints = {fixed, turning};
    return robot;
}

Box box_of(const Vec3& low, const Vec3& high) {
    Box box;
    box.add(low);
    box.add(high);
    return box;
}

TEST(Environment, ReachAndWhatDoesNotMove) {
    const Kinematics kinematics(arm());
    const std::vector<Box> bounds{box_of({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}), box_of({0, 0, 0}, {1, 0, 0.1})};
    Random random(1);
    const Box reached = reach(kinematics, {1, 2}, bounds, random);
    EXPECT_NEAR(reached.low.x, -1, 0.01);
    EXPECT_NEAR(reached.high.y, 1, 0.01);
    EXPECT_EQ(reached.low.z, 0.5);
    EXPECT_EQ(reached.high.z, 0.7);
    const std::vector<Box> fixed = immovable(kinematics, {1, 2}, bounds);
    ASSERT_EQ(fixed.size(), 1u);
    EXPECT_EQ(fixed[0].low, (Vec3{-0.1, -0.1, 0.5}));
}

TEST(Environment, BodyBounds) {
    EngineRobot robot;
    Pose up;
    up.translation = {0, 0, 1};
    robot.bodies = {{{up, Element::box({2, 4, 6})}}};
    EXPECT_EQ(body_bounds(robot)[0].low, (Vec3{-1, -2, -2}));
}

TEST(Environment, SameSeedSameObstaclesWithinBounds) {
    const Box region = box_of({-1, -1, 0}, {1, 1, 1}), base = box_of({-0.2, -0.2, 0}, {0.2, 0.2, 0.3});
    const EnvironmentRule rule{40, 0.1, 0.2};
    Random a(3), b(3);
    const auto first = random_environment(rule, region, {base}, a),
               second = random_environment(rule, region, {base}, b);
    ASSERT_EQ(first.size(), 40u);
    for (std::size_t i = 0; i < first.size(); ++i) {
        const Obstacle& o = first[i];
        EXPECT_EQ(o.pose, second[i].pose);
        EXPECT_EQ(o.shape, second[i].shape);
        EXPECT_EQ(o.shape.kind, i % 2 == 0 ? Element::Kind::box : Element::Kind::sphere);
        const double edge = i % 2 == 0 ? 2 * o.shape.half.x : 2 * o.shape.radius;
        EXPECT_TRUE(edge >= 0.1 && edge <= 0.2);
        const Vec3& c = o.pose.translation;
        EXPECT_TRUE(std::abs(c.x) <= 1 && std::abs(c.y) <= 1 && c.z >= 0 && c.z <= 1);
        EXPECT_FALSE(std::abs(c.x) < 0.2 && std::abs(c.y) < 0.2 && c.z < 0.3);
        EXPECT_NEAR(norm(o.pose.rotation[0]), 1, 1e-12);
        EXPECT_NEAR(dot(cross(o.pose.rotation[0], o.pose.rotation[1]), o.pose.rotation[2]), 1, 1e-12);
    }
}

TEST(Environment, NoRoom) {
    const Box region = box_of({0, 0, 0}, {1, 1, 1});
    Random random(0);
    try {
        random_environment({2, 0.1, 0.2}, region, {region}, random);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "after 10000 draws only 0 of 2 obstacles are clear of the links that do not move; "
                                   "remedy: fewer or smaller obstacles");
    }
}

} // namespace
} // namespace foam
