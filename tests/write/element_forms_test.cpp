// Elements in the words and numbers of files: each form contains the element.
#include "elements.hpp"

#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

double turned_by(const Pose& a, const Pose& b) {
    double squared = 0;
    for (std::size_t row = 0; row < 3; ++row) {
        squared += squared_norm(a.rotation[row] - b.rotation[row]);
    }
    return std::sqrt(squared);
}

TEST(Rotations, QuaternionsAndAnglesGiveTheRotationBack) {
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        const double pitch = i % 3 == 0   ? std::numbers::pi / 2
                             : i % 3 == 1 ? -std::numbers::pi / 2
                                          : random.uniform(-1, 1);
        const Pose pose = Pose::from_xyz_rpy({1, 2, 3}, {random.uniform(-4, 4), pitch, random.uniform(-4, 4)});
        const Pose by_quaternion = from_quaternion({1, 2, 3}, quaternion(pose));
        EXPECT_LT(turned_by(pose, by_quaternion), 3e-15);
        EXPECT_EQ(by_quaternion.translation, pose.translation);
        EXPECT_LT(turned_by(pose, Pose::from_xyz_rpy({}, short_roll_pitch_yaw(pose))), 3e-15);
    }
    const Pose half = from_quaternion({}, {0, 0, 0, 2}); // not a unit quaternion
    EXPECT_EQ(half.rotation, (std::array<Vec3, 3>{Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}));
}

TEST(Rotations, AnglesWithFewDecimalsComeBackAsTheyWere) {
    for (const Vec3& rpy :
         {Vec3{0, 0, 0}, Vec3{1.570796327, 0, 0}, Vec3{0.123457, -0.5, 2.25}, Vec3{0, 0, -3.141592653}}) {
        EXPECT_EQ(short_roll_pitch_yaw(Pose::from_xyz_rpy({}, rpy)), rpy);
    }
}

TEST(StatedAt, ContainsTheElementWhereTheRotationDiffers) {
    Random random(4);
    for (const Element& element : one_of_each()) {
        if (element.kind == Kind::hull) {
            continue;
        }
        EXPECT_EQ(stated_at(element, element.pose), element);
        Pose other = element.pose * Pose::from_axis_angle(normalized({1, 2, 3}), 1e-3);
        other.translation = element.pose.translation;
        const Element stated = stated_at(element, other);
        EXPECT_EQ(stated.pose, other);
        for (const Vec3& point : points_of(element, 2000)) {
            EXPECT_TRUE(holds(stated, point)) << to_string(element.kind);
        }
        EXPECT_LT(volume(stated), volume(element) * 1.05);
    }
}

TEST(CapsuleParts, CoverTheCapsule) {
    for (const Element& whole : {capsule(awkward_pose(), 0.5, 0.25), capsule(awkward_pose(), 1e-9, 1e-9),
                                 capsule(awkward_pose(), 1e-6, 0.25), capsule({}, 10, 0.01)}) {
        const std::vector<Element> parts = capsule_parts(whole);
        ASSERT_EQ(parts.size(), 3U);
        EXPECT_EQ(parts[0].kind, Kind::cylinder);
        EXPECT_EQ(parts[1].kind, Kind::sphere);
        for (const Vec3& point : points_of(whole, 5000)) {
            EXPECT_TRUE(covered(point, {{}, parts}, 1e-15 * (1 + whole.half.z)));
        }
        for (const Element& part : parts) {
            for (const Vec3& point : points_of(part, 1000)) {
                EXPECT_LE(distance(whole, point), 1e-9 * whole.radius + 1e-15 * (1 + whole.half.z));
            }
        }
    }
}

TEST(JoinedCapsules, LieInTheirPartsAndAreWhatTheyWere) {
    for (const Element& whole : {capsule(awkward_pose(), 0.5, 0.25), capsule(awkward_pose(), 1e-6, 0.25),
                                 capsule({}, 10, 0.01), capsule({.translation = {1e6, -1e6, 3}}, 0.3, 0.1)}) {
        std::vector<Element> parts = capsule_parts(whole);
        std::sort(parts.begin(), parts.end(), [](const Element& a, const Element& b) { return a.radius < b.radius; });
        for (int order = 0; order < 3; ++order) {
            std::rotate(parts.begin(), parts.begin() + 1, parts.end());
            const Elements joined = with_joined_capsules(parts);
            ASSERT_EQ(joined.size(), 1U);
            const Element& found = joined.shaped()[0];
            EXPECT_EQ(found.kind, Kind::capsule);
            const double far = norm(whole.pose.translation) + whole.half.z;
            EXPECT_NEAR(found.radius, whole.radius, 1e-14 * far);
            EXPECT_NEAR(found.half.z, whole.half.z, 1e-14 * far);
            for (const Vec3& point : points_of(found, 2000)) {
                EXPECT_TRUE(covered(point, {{}, parts}, 1e-15 * (1 + far)));
            }
        }
    }
}

TEST(JoinedCapsules, OtherNeighboursStayAsTheyAre) {
    const std::vector<Element> parts = capsule_parts(capsule(awkward_pose(), 0.5, 0.25));
    const auto count = [](std::vector<Element> elements) { return with_joined_capsules(elements).size(); };
    const auto with = [&](auto change) {
        std::vector<Element> changed = parts;
        change(changed);
        return changed;
    };
    EXPECT_EQ(count({parts[1], parts[0]}), 2U);
    EXPECT_EQ(count({parts[0], parts[1], parts[1]}), 3U) << "twice the same end";
    EXPECT_EQ(count({parts[0], parts[2], parts[0], parts[1]}), 2U) << "the first cylinder is left alone";
    EXPECT_EQ(count(with([](auto& p) { p[2].radius *= 0.999; })), 3U);
    EXPECT_EQ(count(with([](auto& p) { p[1].pose.translation.x += 1e-9; })), 3U);
    EXPECT_EQ(count(with([](auto& p) { p[0].half.z += 1e-4; })), 3U) << "its rim is outside the capsule";
    EXPECT_EQ(count(with([](auto& p) { p[0].half.z -= 1e-4; })), 3U) << "there is a gap";
    EXPECT_EQ(count({parts[0], parts[1], parts[2], parts[1], parts[0], parts[2]}), 2U);
}

TEST(EnclosingHull, ContainsASweptBox) {
    for (const int segments : {4, 8, 16}) {
        for (const Element& element : {swept_box(awkward_pose(), {0.1, 0.2, 0.3}, 0.1), swept_box({}, {0, 0, 1}, 0.1),
                                       swept_box(awkward_pose(), {1e-9, 2e-9, 0}, 1e-9)}) {
            const Element hull = enclosing_hull(element, segments);
            EXPECT_EQ(hull.kind, Kind::hull);
            for (const Vec3& point : points_of(element, 2000)) {
                EXPECT_TRUE(holds(hull, point));
            }
            EXPECT_LT(volume(hull), volume(element) * (segments == 4 ? 4 : segments == 8 ? 1.7 : 1.2));
        }
    }
}

TEST(Float32Hull, ContainsTheHullAndIsExactInSinglePrecision) {
    Random random(6);
    std::vector<Vec3> ball;
    for (int i = 0; i < 60; ++i) {
        ball.push_back(normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}) * 0.1);
    }
    std::vector<Vec3> plate; // thin, with a slim edge
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            plate.push_back({x, y, 0});
            plate.push_back({x * 0.9, y * 0.9, 1e-4});
        }
    }
    for (const std::vector<Vec3>& points : {ball, plate}) {
        for (const Pose& pose : {Pose{}, awkward_pose(), Pose::from_xyz_rpy({1e6, 2e6, 1.0 / 3}, {1, 2, 3})}) {
            const Element before = hull(pose, points);
            const Element after = float32_hull(before);
            EXPECT_EQ(after.pose.rotation, Pose{}.rotation);
            for (const Vec3& p : after.hull->surface.vertices) {
                for (const double x : {p.x, p.y, p.z}) {
                    EXPECT_EQ(x, static_cast<double>(static_cast<float>(x)));
                }
            }
            for (const Vec3& p : before.hull->surface.vertices) {
                EXPECT_TRUE(holds(after, pose * p));
            }
            EXPECT_LT(volume(after), volume(before) * 1.02);
            EXPECT_LE(after.hull->surface.vertices.size(), before.hull->surface.vertices.size());
            EXPECT_EQ(float32_hull(after), after);
        }
    }
}

/// Each number of vertices: a compiler that rounds several of them at once treats the last ones apart.
TEST(Float32Hull, EachVertexIsExactInSinglePrecision) {
    Random random(11);
    for (int count = 4; count < 24; ++count) {
        std::vector<Vec3> points;
        for (int i = 0; i < count; ++i) {
            points.push_back(normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}) * 0.3);
        }
        const Element after = float32_hull(hull({}, points));
        for (const Vec3& p : after.hull->surface.vertices) {
            const volatile float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
            EXPECT_EQ(p, (Vec3{x, y, z})) << count;
        }
    }
}

TEST(HullIfConvex, TakesConvexMeshesOnly) {
    Mesh cube = enclosing_mesh(box(awkward_pose(), {0.1, 0.2, 0.3}));
    ASSERT_TRUE(hull_if_convex(cube));
    EXPECT_EQ(hull_if_convex(cube)->surface.vertices.size(), 8U);
    Mesh inside_out = cube;
    for (Triangle& t : inside_out.triangles) {
        std::swap(t[0], t[1]);
    }
    EXPECT_TRUE(hull_if_convex(inside_out));
    Mesh open = cube;
    open.triangles.pop_back();
    EXPECT_FALSE(hull_if_convex(open));
    Mesh two = cube;
    append(two, transformed(cube, Pose{.translation = {3, 0, 0}}));
    EXPECT_FALSE(hull_if_convex(two));
    EXPECT_FALSE(hull_if_convex(Mesh{}));
}

} // namespace
} // namespace foam::test
