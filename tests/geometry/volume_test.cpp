// Volumes of unions of parts and of balls.
#include "geometry/shapes.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

constexpr double pi = std::numbers::pi;

Solid::Part mesh_part(Mesh mesh) {
    return {std::make_shared<const Mesh>(std::move(mesh)), std::nullopt, {}};
}

} // namespace

TEST(Volume, ExactWithoutOverlap) {
    const Mesh mesh = torus(1, 0.3, 40);
    EXPECT_NEAR(Solid::make(mesh)->volume(), signed_volume(mesh), 1e-12);
    const Mesh cavity = together(ball({}, 1), flipped(ball({}, 0.5)));
    EXPECT_NEAR(Solid::make(cavity)->volume(), signed_volume(cavity), 1e-12);
    const Mesh apart = together(box({0, 0, 0}, {1, 1, 1}), box({3, 0, 0}, {4, 1, 1}));
    EXPECT_DOUBLE_EQ(Solid::make(apart)->volume(), 2);
}

TEST(Volume, IsNoneBelowTheAccuracyOfItsLines) {
    EXPECT_DOUBLE_EQ(Solid::make(box({0, 0, 0}, {1, 1, 1e-7}))->volume(), 1e-7);
    EXPECT_EQ(Solid::make(box({0, 0, 0}, {1, 1, 1e-10}))->volume(), 0) << "its lines are known to 1e-9 of its size";
    EXPECT_EQ(Solid::make(box({0, 0, 0}, {1, 1e-10, 1e-10}))->volume(), 0);
}

TEST(Volume, OverlappingBoxes) {
    const Mesh a = box({0, 0, 0}, {1, 1, 1}), b = box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
    EXPECT_NEAR(Solid::make(together(a, b))->volume(), 1.875, 2e-3);
    EXPECT_NEAR(Solid::make(std::vector{mesh_part(a), mesh_part(b)})->volume(), 1.875, 2e-3);
    EXPECT_NEAR(Solid::make(std::vector{mesh_part(a), mesh_part(a)})->volume(), 1, 2e-3);
}

TEST(Volume, PrimitiveInMesh) {
    const auto solid = Solid::make(std::vector<Solid::Part>{
        mesh_part(box({-1, -1, -1}, {1, 1, 1})),
        {nullptr, Element::sphere(0.5), Pose::from_xyz_rpy({1, 0, 0}, {})}});
    EXPECT_NEAR(solid->volume(), 8 + 2 / 3.0 * pi * 0.125, 5e-3);
    EXPECT_TRUE(solid->contains({1.4, 0, 0}));
    EXPECT_FALSE(solid->contains({1.4, 0.4, 0}));
    EXPECT_LT(solid->signed_distance({0.9, 0, 0}), -0.39) << "deep in the sphere, near the box's face inside it";
}

TEST(Volume, OpenMesh) {
    Mesh mesh = ball({}, 1, 24);
    const double closed = signed_volume(mesh);
    mesh.triangles.resize(mesh.triangles.size() - 2);
    const auto solid = Solid::make(mesh);
    EXPECT_FALSE(solid->closed());
    EXPECT_NEAR(solid->volume() / closed, 1, 3e-3);
    EXPECT_EQ(solid->volume(), Solid::make(mesh)->volume()) << "the same every time";
}

TEST(UnionVolume, AnalyticCases) {
    const double unit = 4 / 3.0 * pi;
    EXPECT_EQ(union_volume({}), 0);
    const std::vector<Sphere> one{{{5, 6, 7}, 1}};
    EXPECT_NEAR(union_volume(one), unit, 1e-12 * 10);
    const std::vector<Sphere> same{{{}, 1}, {{}, 1}, {{0.1, 0, 0}, 0.5}};
    EXPECT_NEAR(union_volume(same), unit, 1e-5);
    const std::vector<Sphere> apart{{{}, 1}, {{3, 0, 0}, 0.5}};
    EXPECT_NEAR(union_volume(apart), unit * 1.125, 1e-3);
    // Two unit balls at distance d overlap in a lens of π (4 + d) (2 - d)² / 12.
    for (const double d : {0.3, 1.0, 1.9}) {
        const std::vector<Sphere> two{{{}, 1}, {{0, 0, d}, 1}};
        EXPECT_NEAR(union_volume(two), 2 * unit - pi * (4 + d) * (2 - d) * (2 - d) / 12, 0.01);
        EXPECT_NEAR(union_volume(two, 100'000), 2 * unit - pi * (4 + d) * (2 - d) * (2 - d) / 12, 2e-4);
    }
}

TEST(ExactUnionVolume, ClosedForms) {
    const double unit = 4 / 3.0 * pi;
    EXPECT_EQ(exact_union_volume({}), 0);
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{5, 6, 7}, 1}}), unit, 1e-13);
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, {{}, 1}, {{0.1, 0, 0}, 0.5}, {{}, 1}}), unit, 1e-13);
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, {{3, 0, 0}, 0.5}}), unit * 1.125, 1e-13);
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, {{1.5, 0, 0}, 0.5}}), unit * 1.125, 1e-13) << "touch";
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, {{0.5, 0, 0}, 0.5}}), unit, 1e-13) << "touch inside";
    for (const double d : {1e-3, 0.3, 1.0, 1.9, 1.999}) {
        const std::vector<Sphere> two{{{}, 1}, {{0, 0, d}, 1}};
        EXPECT_NEAR(exact_union_volume(two), 2 * unit - pi * (4 + d) * (2 - d) * (2 - d) / 12, 1e-12) << d;
    }
}

// Only balls near each other along x are compared: sizes of every order, and groups far apart.
TEST(ExactUnionVolume, OfGroupsApartIsTheSumOfTheirs) {
    Random random(7);
    std::vector<Sphere> all;
    double sum = 0;
    for (int group = 0; group < 12; ++group) {
        const Vec3 middle{40.0 * (group % 3), 40.0 * (group / 3 % 2), 40.0 * (group / 6)};
        std::vector<Sphere> balls;
        for (int i = 0; i < 30; ++i) {
            const Vec3 offset{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
            balls.push_back({middle + offset, std::pow(10, random.uniform(-3, 0.9))});
        }
        sum += exact_union_volume(balls);
        all.insert(all.begin() + static_cast<std::ptrdiff_t>(random.below(all.size() + 1)), balls.begin(), balls.end());
    }
    EXPECT_NEAR(exact_union_volume(all), sum, 1e-9 * sum);
}

TEST(ExactUnionVolume, DegenerateArrangements) {
    // A row of three of which the middle one lies between the circles of the others; three that share a circle.
    const double lens = pi * 5 / 12; // of unit balls at distance 1
    const double unit = 4 / 3.0 * pi;
    EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{0, 0, 0}, 1}, {{0, 0, 1}, 1}, {{0, 0, 2}, 1}}),
                3 * unit - 2 * lens, 1e-12);
    const double wide = std::sqrt(2.0);
    const std::vector<Sphere> shared{{{0, 0, 0}, 1}, {{0, 0, 1}, wide}, {{0, 0, -1}, wide}};
    const std::vector<Sphere> pair{{{0, 0, 1}, wide}, {{0, 0, -1}, wide}};
    EXPECT_NEAR(exact_union_volume(shared), exact_union_volume(pair), 1e-12) << "the first lies within the others";
    // Corners of a cube with circumscribed balls of radius √3/2: all spheres meet in its centre, and pairs in one
    // plane.
    std::vector<Sphere> cube;
    for (int i = 0; i < 8; ++i) {
        cube.push_back({{i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0}, std::sqrt(3.0) / 2});
    }
    EXPECT_NEAR(exact_union_volume(cube), 4 * pi + 2, 1e-12);
    std::vector<Sphere> twice = cube;
    twice.insert(twice.end(), cube.begin(), cube.end());
    EXPECT_NEAR(exact_union_volume(twice), exact_union_volume(cube), 1e-12);
}

TEST(ExactUnionVolume, AgreesWithQuadratureOnRandomBalls) {
    Random random(7);
    for (const std::size_t count : {5, 20, 60}) {
        std::vector<Sphere> balls;
        for (std::size_t i = 0; i < count; ++i) {
            balls.push_back({{random.uniform(), random.uniform(), random.uniform()}, 0.05 + 0.3 * random.uniform()});
        }
        const double exact = exact_union_volume(balls);
        EXPECT_NEAR(exact / union_volume(balls, 50'000), 1, 2e-4) << count;
        std::reverse(balls.begin(), balls.end());
        EXPECT_NEAR(exact_union_volume(balls) / exact, 1, 1e-13) << "the order is of no concern";
        for (Sphere& ball : balls) {
            ball.center += Vec3{100, -50, 7};
        }
        EXPECT_NEAR(exact_union_volume(balls) / exact, 1, 1e-10) << "nor the place";
    }
}

TEST(ExactUnionVolume, IgnoresWhatIsNoBall) {
    const std::vector<Sphere> spheres{{{}, 1}, {{}, -3}, {{std::nan(""), 0, 0}, 2}, {{1, 0, 0}, 0}, {{}, std::nan("")}};
    EXPECT_NEAR(exact_union_volume(spheres), 4 / 3.0 * pi, 1e-13);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Sphere& none : {Sphere{{9, 0, 0}, -1}, Sphere{{9, 0, 0}, infinity}, Sphere{{9, 0, 0}, -infinity}}) {
        EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, none}), 4 / 3.0 * pi, 1e-13);
    }
}

TEST(UnionVolume, IgnoresWhatIsNoBall) {
    const std::vector<Sphere> spheres{{{}, 1}, {{}, -3}, {{std::nan(""), 0, 0}, 2}, {{1, 0, 0}, 0}, {{}, std::nan("")}};
    EXPECT_NEAR(union_volume(spheres), 4 / 3.0 * pi, 1e-9);
}

TEST(ExactUnionVolume, PartsThatStayedAreTakenOver) {
    // Balls that change, come, go or change places, against the parts of all anew: to the last bit.
    Random random(8);
    const auto ball = [&] {
        return Sphere{{random.uniform(), random.uniform(), random.uniform()}, 0.05 + 0.2 * random.uniform()};
    };
    std::vector<Sphere> balls;
    for (int i = 0; i < 12; ++i) {
        balls.push_back(ball());
    }
    geometry::UnionParts parts(balls);
    for (int round = 0; round < 200; ++round) {
        const auto i = static_cast<std::size_t>(random.uniform() * static_cast<double>(balls.size()));
        switch (round % 5) {
        case 0:
            balls[i].radius *= 0.5;
            break;
        case 1:
            balls.push_back(ball());
            break;
        case 2:
            balls.pop_back();
            break;
        case 3:
            balls[i] = ball();
            break;
        default:
            std::swap(balls[0], balls[i]);
            break;
        }
        parts = parts.with(balls);
        EXPECT_EQ(parts.volume(), geometry::UnionParts(balls).volume()) << round;
    }
    EXPECT_EQ(parts.with({}).volume(), 0);
}

TEST(ExactUnionVolume, TheDirectionIsOfNoConcern) {
    // Directions of axes, and the one that the closed form turns exactly upwards.
    const Vec3 upwards{0.5826116723815148, -0.6112908014436207, 0.5356185165537463};
    Random random(9);
    for (const Vec3& up : {upwards, -1 * upwards, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const Vec3 aside = normalized(cross(up, Vec3{0.3, 0.2, 0.7})), third = cross(up, aside);
        const std::vector<Sphere> given{
            {{}, 1}, {up, 1}, {-0.9 * up, 0.8}, {0.8 * aside + 0.4 * up, 0.9}, {0.7 * third - 0.2 * up, 0.7}};
        std::vector<Sphere> turned = given;
        const Pose pose = random_pose(random, 1);
        for (Sphere& sphere : turned) {
            sphere.center = pose * sphere.center;
        }
        const double volume = exact_union_volume(given);
        EXPECT_NEAR(volume, exact_union_volume(turned), 1e-12 * volume);
        EXPECT_NEAR(volume, union_volume(given, 100'000), 1e-3 * volume);
    }
}

TEST(ExactUnionVolume, ACircleThroughTheAreasPole) {
    // The area is integrated about one point of each ball: circles that pass exactly through it, and a last bit beside.
    for (const Sphere& given :
         {Sphere{{0.039, 0.487, -0.657}, 0.6454322110710405}, Sphere{{-0.463, 0.038, -0.585}, 0.5877140683164919},
          Sphere{{-1.07, -0.063, 0.468}, 1.3036355294252158}, Sphere{{0.416, -0.613, -0.642}, 1.5834867409411066}}) {
        const double d = norm(given.center);
        for (const double r : {given.radius, std::nextafter(given.radius, 9), std::nextafter(given.radius, 0)}) {
            const double deep = 1 + r - d;
            const double lens = pi * deep * deep * (d * d + 2 * d * (1 + r) - 3 * (1 - r) * (1 - r)) / (12 * d);
            EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{{{}, 1}, {given.center, r}}),
                        4 / 3.0 * pi * (1 + r * r * r) - lens, 1e-12 * (1 + r * r * r));
        }
    }
}

TEST(ExactUnionVolume, FarFromTheOriginNoDigitIsLost) {
    // Places that a shift by a power of two does not round.
    Random random(11);
    std::vector<Sphere> balls;
    for (int i = 0; i < 8; ++i) {
        const auto at = [&] { return std::ldexp(std::round(std::ldexp(random.uniform(), 12)), -12); };
        balls.push_back({{at(), at(), at()}, random.uniform(0.2, 0.5)});
    }
    std::vector<Sphere> away = balls;
    for (Sphere& ball : away) {
        ball.center += Vec3{std::ldexp(1, 34), -std::ldexp(1, 33), std::ldexp(1, 35)};
    }
    EXPECT_NEAR(exact_union_volume(away), exact_union_volume(balls), 1e-12);
}

TEST(ExactUnionVolume, BallsThatHardlyTouch) {
    // Above each other and anyhow, to a last bit, where caps have no width.
    const Vec3 upwards{0.5826116723815148, -0.6112908014436207, 0.5356185165537463};
    Random random(10);
    for (int round = 0; round < 3000; ++round) {
        const double large = random.uniform(0.5, 2), small = large * std::pow(10, random.uniform(-6, 0));
        const auto volume = [](double r) { return 4 / 3.0 * pi * r * r * r; };
        double outside = large + small, inside = large - small;
        for (int k = 0; k < round % 4; ++k) {
            outside = std::nextafter(outside, 0);
            inside = std::nextafter(inside, 9);
        }
        Vec3 way = round % 3 == 0 ? random_direction(random) : (round % 8 < 4 ? 1 : -1) * upwards;
        way[round % 3] = std::nextafter(way[round % 3], random.uniform(-9, 9));
        const Sphere ball{{}, large};
        EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{ball, {way * outside, small}}),
                    volume(large) + volume(small), 1e-12 * volume(large));
        EXPECT_NEAR(exact_union_volume(std::vector<Sphere>{ball, {way * inside, small}}), volume(large),
                    1e-12 * volume(large));
    }
}
