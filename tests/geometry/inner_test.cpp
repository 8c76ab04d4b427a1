// The proof that spheres lie in a solid: it must hold where it can, and never where a point of a sphere is outside.
#include "geometry/shapes.hpp"

#include <foam/inner.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

double inner_radius(const Solid& solid, const Vec3& center, double most = 10) {
    return inner_radii(solid, std::vector<Sphere>{{center, most}}).front();
}

/// How far points of the ball are outside, by many samples.
double sticks_out(const Solid& solid, const Sphere& ball, Random& random) {
    double most = 0;
    for (int i = 0; i < 2'000; ++i) {
        const Vec3 p = ball.center + random_direction(random) * (ball.radius * (i % 2 == 0 ? 1 : random.uniform()));
        most = std::max(most, solid.contains(p) ? 0 : solid.signed_distance(p));
    }
    return most;
}

/// The unit cube about the origin without its top.
Mesh open_cube() {
    Mesh mesh = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.vertices[t[0]].z > 0 && mesh.vertices[t[1]].z > 0 && mesh.vertices[t[2]].z > 0;
    });
    return mesh;
}

} // namespace

TEST(Inner, ACubesLargestBall) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    EXPECT_NEAR(inner_radius(*cube, {}), 1, 1e-12);
    EXPECT_LE(inner_radius(*cube, {}), 1);
    EXPECT_NEAR(inner_radius(*cube, {0.25, 0, 0}), 0.75, 1e-12);
    EXPECT_EQ(inner_radius(*cube, {0.25, 0, 0}, 0.5), 0.5) << "no more than asked for";
    EXPECT_EQ(inner_radius(*cube, {1.5, 0, 0}), 0);
    EXPECT_EQ(inner_radius(*cube, {1, 0, 0}), 0) << "on the surface";
    EXPECT_TRUE(certify_inner(*cube, std::vector<Sphere>{{{}, 1 - 1e-12}, {{0.5, 0, 0}, 0.4}}).holds);
    EXPECT_TRUE(certify_inner(*cube, std::vector<Sphere>{}).holds);
    const InnerCertificate out = certify_inner(*cube, std::vector<Sphere>{{{}, 1}, {{0.5, 0, 0}, 0.6}, {{}, 0.3}});
    EXPECT_FALSE(out.holds);
    EXPECT_EQ(out.sphere, 1u);
    EXPECT_NEAR(out.excess, 0.1, 1e-9);
    EXPECT_FALSE(certify_inner(*cube, std::vector<Sphere>{{{}, std::nextafter(1.0, 2.0)}}).holds);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(certify_inner(*cube, std::vector<Sphere>{{{}, nan}}).holds);
    EXPECT_FALSE(certify_inner(*cube, std::vector<Sphere>{{{nan, 0, 0}, 0.1}}).holds);
}

TEST(Inner, WhatIsProvedOnceIsProvedAgain) {
    // Far from the origin the slack is larger than small radii, and has other last digits.
    const auto cube = Solid::make(box({1, 2, 3}, {1.0001, 2.0001, 3.0001}));
    Random random(1);
    for (int k = 0; k < 2'000; ++k) {
        const double radius = std::pow(10, random.uniform(-12.3, -5));
        EXPECT_EQ(inner_radius(*cube, {1.00005, 2.00005, 3.00005}, radius), radius);
    }
}

TEST(Inner, PrimitivesAreExact) {
    Random random(3);
    for (const auto kind :
         {Primitive::Kind::sphere, Primitive::Kind::box, Primitive::Kind::cylinder, Primitive::Kind::capsule}) {
        const auto solid = primitive_solid({kind, {0.4, 0.4, 0.4}, 0.2, 0.4}, random_pose(random, 3));
        EXPECT_NEAR(inner_radius(*solid, solid->bounds().center()), 0.2, 1e-9) << static_cast<int>(kind);
    }
}

TEST(Inner, NoPointOfAProvedBallIsOutside) {
    Random random(1);
    const std::vector<Mesh> meshes{torus(1, 0.3),
                                   box({0, 0, 0}, {3, 1, 0.2}),
                                   flipped(ball({}, 1)),
                                   soup(ball({}, 1)),
                                   together(box({0, 0, 0}, {1, 1, 1}), box({0.5, 0, 0}, {2, 1, 1})),
                                   together(ball({}, 1), flipped(ball({}, 0.6)))};
    std::size_t proved = 0;
    for (const Mesh& mesh : meshes) {
        const auto solid = Solid::make(mesh);
        for (int i = 0; i < 40; ++i) {
            const Sphere ball{random_point(random, solid->bounds()), 10};
            const double radius = inner_radii(*solid, std::vector<Sphere>{ball}).front();
            EXPECT_LE(radius, std::max(0.0, -solid->signed_distance(ball.center)));
            if (radius > 0) {
                ++proved;
                EXPECT_LE(sticks_out(*solid, {ball.center, radius}, random), 1e-9) << &mesh - meshes.data();
            }
        }
    }
    EXPECT_GT(proved, 40u);
}

TEST(Inner, TheRimOfAnOpenMeshHoldsBack) {
    const auto cube = Solid::make(open_cube());
    ASSERT_FALSE(cube->closed());
    EXPECT_GT(inner_radius(*cube, {}), 0.3);
    EXPECT_LE(inner_radius(*cube, {}), 0.5);
    // Deep down the opening is far, near the middle of the opening the winding number is one half: no room.
    EXPECT_NEAR(inner_radius(*cube, {0, 0, -0.4}), 0.1, 1e-6);
    EXPECT_LT(inner_radius(*cube, {0, 0, 0.45}), 0.1);
    EXPECT_EQ(inner_radius(*cube, {0, 0, 0.55}), 0);
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const Vec3 center = random_point(random, cube->bounds());
        const double radius = inner_radius(*cube, center);
        EXPECT_TRUE(radius == 0 || certify_inner(*cube, std::vector<Sphere>{{center, radius * (1 - 1e-6)}}).holds)
            << "what is proved for a ball is proved for a smaller one";
        if (radius > 0) {
            EXPECT_LE(sticks_out(*cube, {center, radius}, random), 1e-9);
        }
    }
}

TEST(Inner, ASheetHasNoRoom) {
    const Mesh sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}, {0, 2, 1}, {1, 2, 3}}};
    const auto solid = Solid::make(sheet);
    EXPECT_EQ(inner_radius(*solid, {0.5, 0.5, 0.01}), 0);
    EXPECT_EQ(inner_radius(*solid, {0.5, 0.5, -0.01}), 0);
}

TEST(Inner, SpheresShrinkMoveInOrGo) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    const std::vector<Sphere> fitted = shrunk_to_fit(*rod, {{{0.5, 0.5, 0.5}, 0.9},   // shrinks
                                                            {{2, 0.5, 0.5}, 0.3},     // stays
                                                            {{2.1, 0.5, 0.5}, 0.1},   // lies in the one before
                                                            {{3.5, 0.5, 1.2}, 1},     // moves in
                                                            {{3, 0.5, 5}, 1},         // too far out
                                                            {{0.5, 0.5, 0.5}, 0.9}}); // the first again
    ASSERT_EQ(fitted.size(), 6u);
    EXPECT_NEAR(fitted[0].radius, 0.5, 1e-9);
    EXPECT_EQ(fitted[1], (Sphere{{2, 0.5, 0.5}, 0.3}));
    EXPECT_EQ(fitted[2].radius, 0);
    EXPECT_GT(fitted[3].radius, 0.4);
    EXPECT_EQ(fitted[4].radius, 0);
    EXPECT_EQ(fitted[5].radius, 0);
    EXPECT_TRUE(certify_inner(*rod, fitted).holds);
}

TEST(Inner, PartsProveOnTheirOwn) {
    const auto solid = Solid::make(
        {Solid::Part{std::make_shared<const Mesh>(box({0, 0, 0}, {1, 1, 1})), {}, {}},
         Solid::Part{{}, Primitive{Primitive::Kind::sphere, {}, 0.4, 0}, Pose::from_xyz_rpy({3, 0, 0}, {})}});
    EXPECT_NEAR(inner_radius(*solid, {0.5, 0.5, 0.5}), 0.5, 1e-9);
    EXPECT_NEAR(inner_radius(*solid, {3, 0, 0}), 0.4, 1e-9);
    EXPECT_EQ(inner_radius(*solid, {2, 0, 0}), 0);
}
