// The bounds that a proof of a least element rests on: no element along an orientation of a cell is smaller.
#include "convex/random_points.hpp"
#include "geometry/plain_shapes.hpp"
#include "search/src/convex/least_fit.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace foam {
namespace {

using namespace search::convex;
using std::numbers::pi;
using ::testing::Each;
using ::testing::SizeIs;

/// A cell as after some halvings, chosen by chance.
Orientations random_cell(Random& random, bool of_axis) {
    std::vector<Orientations> cells = all_orientations(of_axis);
    Orientations cell = cells[random.below(cells.size())];
    for (std::uint64_t k = random.below(4) ? random.below(5) : 20; k > 0; --k) { // some tiny ones
        cells = parts_of(cell, of_axis);
        cell = cells[random.below(cells.size())];
    }
    return cell;
}

/// A place in the cell; in every fourth case a corner.
Vec3 place_in(const Orientations& cell, bool of_axis, Random& random) {
    const bool corner = random.below(4) == 0;
    const auto along = [&] { return cell.half * (corner ? (random.below(2) ? 1 : -1) : random.uniform(-1, 1)); };
    const double x = along(), y = along(), z = along();
    return cell.at + Vec3{x, y, of_axis ? 0 : z};
}

Orientations at_place(Orientations cell, const Vec3& at) {
    cell.at = at;
    return cell;
}

/// The angle between two frames, or between two directions but for their sign, exact for small ones.
double angle_between(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    const Vec3 twice_axis = cross(a[0], b[0]) + cross(a[1], b[1]) + cross(a[2], b[2]);
    const double trace = dot(a[0], b[0]) + dot(a[1], b[1]) + dot(a[2], b[2]);
    return std::atan2(norm(twice_axis), trace - 1);
}
double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(norm(cross(a, b)), std::abs(dot(a, b)));
}

/// Points of all kinds of shapes: long, flat, even.
Cloud random_cloud(Random& random) {
    const Vec3 size{random.uniform(0.01, 1), random.uniform(0.01, 1), random.uniform(0.01, 1)};
    const Pose pose = test::random_pose(random, 1);
    const std::vector<Vec3> points = test::random_points(random, 12, size, pose);
    return cloud_of(points);
}

TEST(OrientationBounds, TheReachIsTheLargestAngleInACell) {
    Random random(1);
    for (int round = 0; round < 200; ++round) {
        for (const bool of_axis : {false, true}) {
            const Orientations cell = random_cell(random, of_axis);
            const double most = reach(cell, of_axis);
            double largest = 0;
            for (int k = 0; k < 200; ++k) {
                const Vec3 at = place_in(cell, of_axis, random);
                const double angle = of_axis ? angle_between(direction_at(cell), direction_at(at_place(cell, at)))
                                             : angle_between(axes_at(cell.at), axes_at(at));
                EXPECT_LE(angle, most);
                largest = std::max(largest, angle);
            }
            EXPECT_GT(largest, most - 5e-12) << "one of the corners has it";
        }
    }
}

TEST(OrientationBounds, TheCellsHaveAllOrientations) {
    Random random(2);
    EXPECT_THAT(all_orientations(true), SizeIs(3));
    EXPECT_THAT(all_orientations(false), SizeIs(1));
    for (const Orientations& cell : all_orientations(true)) {
        EXPECT_EQ(cell.half, 1);
    }
    EXPECT_NEAR(all_orientations(false)[0].half, std::sqrt(2) - 1, 1e-11) << "no more than is needed";
    EXPECT_GT(all_orientations(false)[0].half, std::sqrt(2) - 1) << "an eighth of a turn about an axis";
    for (int round = 0; round < 2000; ++round) {
        const Vec3 direction = test::random_direction(random);
        int found = 0;
        for (const Orientations& cell : all_orientations(true)) {
            found += angle_between(direction_at(cell), direction) <= reach(cell, true);
        }
        EXPECT_GT(found, 0);
        // One of the 24 turns of a cube brings any frame near.
        const std::array<Vec3, 3> axes = axes_at(test::random_direction(random) * random.uniform(0, 3));
        double nearest = pi;
        for (int x = 0; x < 3; ++x) {
            for (int y = 0; y < 3; ++y) {
                for (int signs = 0; signs < 4 && x != y; ++signs) {
                    const auto i = static_cast<std::size_t>(x), k = static_cast<std::size_t>(y);
                    const Vec3 a = axes[i] * (signs & 1 ? -1 : 1), b = axes[k] * (signs & 2 ? -1 : 1);
                    nearest = std::min(nearest, angle_between({a, b, cross(a, b)}, axes_at({})));
                }
            }
        }
        EXPECT_LE(nearest, reach(all_orientations(false)[0], false));
    }
}

TEST(OrientationBounds, ThePartsTileTheCell) {
    Random random(3);
    for (int round = 0; round < 500; ++round) {
        for (const bool of_axis : {false, true}) {
            const Orientations cell = random_cell(random, of_axis);
            const std::vector<Orientations> parts = parts_of(cell, of_axis);
            EXPECT_THAT(parts, SizeIs(of_axis ? 4 : 8));
            const Vec3 at = place_in(cell, of_axis, random);
            EXPECT_TRUE(std::any_of(parts.begin(), parts.end(), [&](const Orientations& part) {
                const Vec3 off = at - part.at;
                return part.half == cell.half / 2 && part.face == cell.face &&
                       std::max({std::abs(off.x), std::abs(off.y), std::abs(off.z)}) <= part.half * (1 + 1e-12) + 1e-15;
            }));
        }
    }
}

TEST(OrientationBounds, DirectionsAreThoseOfTheFaces) {
    EXPECT_EQ(direction_at({.at = {}, .half = 1, .face = 0}), (Vec3{1, 0, 0}));
    EXPECT_EQ(direction_at({.at = {}, .half = 1, .face = 1}), (Vec3{0, 1, 0}));
    EXPECT_EQ(direction_at({.at = {}, .half = 1, .face = 2}), (Vec3{0, 0, 1}));
    EXPECT_NEAR(distance(direction_at({.at = {0.5, -1, 0}, .half = 1, .face = 1}), normalized({-1, 1, 0.5})), 0, 1e-15);
}

TEST(OrientationBounds, NoBoxOfACellIsSmaller) {
    Random random(4);
    for (int round = 0; round < 300; ++round) {
        const Cloud cloud = random_cloud(random);
        const Orientations cell = random_cell(random, false);
        const std::array<Vec3, 3> axes = axes_at(cell.at);
        const double bound = bound_of_box(cloud, axes, reach(cell, false));
        for (int k = 0; k < 100; ++k) {
            EXPECT_LE(bound, volume(box_along(cloud, axes_at(place_in(cell, false, random)))) * (1 + 1e-12));
        }
        EXPECT_NEAR(bound_of_box(cloud, axes, 0), volume(box_along(cloud, axes)), 1e-12) << "exact without an angle";
    }
}

TEST(OrientationBounds, NoCylinderOfACellIsSmaller) {
    Random random(5);
    for (int round = 0; round < 300; ++round) {
        const Cloud cloud = random_cloud(random);
        const Orientations cell = random_cell(random, true);
        const Fit here = cylinder_along(cloud, direction_at(cell));
        const double bound = bound_of_cylinder(cloud, here, reach(cell, true));
        for (int k = 0; k < 100; ++k) {
            const Vec3 direction = direction_at(at_place(cell, place_in(cell, true, random)));
            EXPECT_LE(bound, volume(cylinder_along(cloud, direction)) * (1 + 1e-9));
        }
        EXPECT_NEAR(bound_of_cylinder(cloud, here, 0), volume(here), 1e-9 * volume(here));
    }
}

double least_capsule_along(const Cloud& cloud, const Vec3& direction) {
    return volume(descended(capsule_along(cloud, direction), cloud, 60, 0.1, true));
}

TEST(OrientationBounds, NoCapsuleOfACellIsSmaller) {
    Random random(6);
    for (int round = 0; round < 40; ++round) {
        const Cloud cloud = random_cloud(random);
        const Orientations cell = random_cell(random, true);
        const double here = least_capsule_along(cloud, direction_at(cell));
        const double bound = bound_of_capsule(here, reach(cell, true));
        for (int k = 0; k < 20; ++k) {
            const Vec3 direction = direction_at(at_place(cell, place_in(cell, true, random)));
            EXPECT_LE(bound, least_capsule_along(cloud, direction) * (1 + 1e-6));
        }
        EXPECT_EQ(bound_of_capsule(here, 0), here);
    }
}

TEST(OrientationBounds, ALayerIsTakenOffACapsule) {
    for (const double angle : {0.01, 0.1, 0.5}) {
        for (const double radius : {1e-4, 0.05, 0.2, 0.5, 20.0}) {
            const double here = pi * radius * radius + 4 * pi / 3 * radius * radius * radius;
            const double layer = std::sin(angle / 2) * (2 * pi * radius + 4 * pi * radius * radius);
            EXPECT_NEAR(bound_of_capsule(here, angle), here - layer, 1e-11 * layer);
            // Of no shorter capsule of that volume is the layer more.
            for (double shorter = 0; shorter < 1; shorter += 0.01) {
                double r = radius, volume_of = 0;
                for (int k = 0; k < 100; ++k) { // Newton's method, from below
                    volume_of = pi * r * r * shorter + 4 * pi / 3 * r * r * r;
                    r += (here - volume_of) / (2 * pi * r * shorter + 4 * pi * r * r);
                }
                EXPECT_NEAR(volume_of, here, 1e-9 * here);
                EXPECT_LE(shorter * std::sin(angle / 2) * (2 * pi * r * shorter + 4 * pi * r * r), layer);
            }
        }
    }
}

TEST(OrientationBounds, ALineBetweenTwoPointsIsKnown) {
    Random random(8);
    for (int round = 0; round < 1000; ++round) {
        const Vec3 along = test::random_direction(random);
        const std::vector<Vec3> line{{}, along};
        const Cloud cloud = cloud_of(line);
        const double length = distance(cloud.points.front(), cloud.points.back());
        const std::array<Vec3, 3> axes = frame_along(along);
        const double angle = random.uniform(0, 1.5);
        EXPECT_NEAR(bound_of_box(cloud, axes, 0), length * 4 * thin * thin, 1e-12 * thin * thin) << "exact along it";
        EXPECT_DOUBLE_EQ(bound_of_box(cloud, axes, 2), 8 * thin * thin * thin) << "there is always a thickness";
        const Fit cylinder = cylinder_along(cloud, along);
        EXPECT_NEAR(bound_of_cylinder(cloud, cylinder, angle), pi * thin * thin * length * std::cos(angle), 1e-18);
    }
    const std::vector<Vec3> point{{1, 2, 3}};
    for (const double angle : {0.0, 1.0}) {
        EXPECT_DOUBLE_EQ(bound_of_box(cloud_of(point), axes_at({}), angle), 8 * thin * thin * thin);
    }
}

TEST(OrientationBounds, ATurnedCylinderHasNoLessThanItsBound) {
    // Around the rims of a cylinder, seen from a direction at an angle: long ones leave the bound the least room.
    for (const double radius : {0.001, 0.01, 0.1, 0.5}) {
        std::vector<Vec3> rims;
        for (int k = 0; k < 128; ++k) {
            const double turn = 2 * pi * k / 64;
            rims.push_back({radius * std::cos(turn), radius * std::sin(turn), k < 64 ? 0.5 : -0.5});
        }
        const Cloud cloud = cloud_of(rims);
        const double least = volume(cylinder_along(cloud, {0, 0, 1}));
        for (const double angle : {1e-4, 1e-3, 0.01, 0.03, 0.1, 0.2, 0.3, 0.5, 0.8}) {
            const Fit here = cylinder_along(cloud, {std::sin(angle), 0, std::cos(angle)});
            const double bound = bound_of_cylinder(cloud, here, angle);
            EXPECT_LE(bound, least) << radius << " " << angle;
            if (angle < 0.02) {
                const double off = 2 * angle + angle * angle / radius; // of the extent, and of the radius
                EXPECT_GE(bound, least * (1 - 2 * off)) << radius << " " << angle;
            }
        }
    }
}

} // namespace
} // namespace foam
