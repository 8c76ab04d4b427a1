// The proof that spheres lie in a solid: it must hold where it can, and never where a point of a sphere is outside.
#include "geometry/shapes.hpp"

#include <foam/geometry/inner.hpp>

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
    for (const Element& primitive : {Element::sphere(0.2), Element::box({0.4, 0.4, 0.4}), Element::cylinder(0.2, 0.4),
                                     Element::capsule(0.2, 0.4), Element::ellipsoid({0.4, 0.2, 0.3})}) {
        const auto solid = primitive_solid(primitive, random_pose(random, 3));
        EXPECT_NEAR(inner_radius(*solid, solid->bounds().center()), 0.2, 1e-9) << to_string(primitive.kind);
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
         Solid::Part{{}, Element::sphere(0.4), Pose::from_xyz_rpy({3, 0, 0}, {})}});
    EXPECT_NEAR(inner_radius(*solid, {0.5, 0.5, 0.5}), 0.5, 1e-9);
    EXPECT_NEAR(inner_radius(*solid, {3, 0, 0}), 0.4, 1e-9);
    EXPECT_EQ(inner_radius(*solid, {2, 0, 0}), 0);
}

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
__extension__ typedef __float128 Quad;

/// Distance of a point from a triangle's plane, exact to 30 digits.
double exact_distance(const Mesh& mesh, const Triangle& t, const Vec3& p) {
    const auto from = [](const Vec3& a, const Vec3& b) {
        return std::array<Quad, 3>{Quad(b.x) - a.x, Quad(b.y) - a.y, Quad(b.z) - a.z};
    };
    const auto u = from(mesh.vertices[t[0]], mesh.vertices[t[1]]), v = from(mesh.vertices[t[0]], mesh.vertices[t[2]]);
    const auto w = from(mesh.vertices[t[0]], p);
    const std::array<Quad, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const Quad height = n[0] * w[0] + n[1] * w[1] + n[2] * w[2], square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const Quad squared_distance = height * height / square;
    double root = std::sqrt(static_cast<double>(squared_distance));
    while (Quad(root) * root > squared_distance) {
        root = std::nextafter(root, 0);
    }
    return root;
}

} // namespace

TEST(Inner, NoRadiusIsAboveTheExactDistance) {
    // Small and large convex solids, near and far, turned: the least distance from a face's plane is the exact answer.
    Random random(11);
    for (const double offset : {0.0, 1.0, 1e4}) {
        for (int round = 0; round < 100; ++round) {
            const double size = std::pow(10, random.uniform(-2, 2));
            const Pose pose = Pose::from_xyz_rpy(random_direction(random) * offset, random_direction(random) * 3);
            const Mesh mesh = transformed(box({-1, -1, -1}, {1, 1, 1}), pose, {size, 2 * size, 3 * size});
            const auto solid = Solid::make(mesh);
            const Vec3 center =
                pose * (Vec3{random.uniform(-0.5, 0.5), random.uniform(-1, 1), random.uniform(-1, 1)} * size);
            double exact = std::numeric_limits<double>::infinity(), extent = 0;
            for (const Triangle& t : mesh.triangles) {
                exact = std::min(exact, exact_distance(mesh, t, center));
            }
            for (int axis = 0; axis < 3; ++axis) {
                extent = std::max({extent, std::abs(solid->bounds().low[axis]), std::abs(solid->bounds().high[axis])});
            }
            const double radius = inner_radius(*solid, center, 1e6), slack = 64 * epsilon * (extent + norm(center));
            EXPECT_LE(radius, exact);
            EXPECT_GE(radius, exact - 1.2 * slack) << "caution costs no more than that";
            EXPECT_LE(radius, exact - 0.8 * slack);
            EXPECT_FALSE(certify_inner(*solid, std::vector<Sphere>{{center, std::nextafter(radius, 1e9)}}).holds);
            EXPECT_TRUE(certify_inner(*solid, std::vector<Sphere>{{center, radius}}).holds);
        }
    }
}

TEST(Inner, SlackIsOfTheLargestCoordinate) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-7.0, 7.0}) {
            Vec3 low{-1, -1, -1}, high{1, 1, 1}, center{0, 0, 0};
            (side < 0 ? low : high)[axis] = side;
            center[(axis + 1) % 3] = 0.5;
            EXPECT_NEAR(0.5 - inner_radius(*Solid::make(box(low, high)), center), 64 * epsilon * 7.5, 4 * epsilon);
        }
    }
}

TEST(Inner, BallsTooSmallToTellAreNotProved) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double least = 1e-9 * std::sqrt(12.0);
    EXPECT_EQ(inner_radius(*cube, {}, 1.001 * least), 1.001 * least);
    EXPECT_EQ(inner_radius(*cube, {}, 0.999 * least), 0);
    EXPECT_GT(inner_radius(*cube, {1 - 1.01 * least, 0, 0}), 0);
    EXPECT_EQ(inner_radius(*cube, {1 - 0.99 * least, 0, 0}), 0);
    const auto round = primitive_solid(Element::sphere(1));
    EXPECT_EQ(inner_radius(*round, {}, 1.01 * least), 1.01 * least);
    EXPECT_EQ(inner_radius(*round, {}, 0.99 * least), 0);
    EXPECT_EQ(inner_radius(*round, {}, 0), 0);
    EXPECT_EQ(inner_radius(*round, {}, -1), 0);
}

TEST(Inner, OrientationAndHollows) {
    const double flat_side = Solid::make(ball({}, 1))->signed_distance({});
    for (const Mesh& mesh : {ball({}, 1), flipped(ball({}, 1)), soup(ball({}, 1))}) {
        EXPECT_NEAR(inner_radius(*Solid::make(mesh), {}), -flat_side, 1e-12);
    }
    const auto hollow = Solid::make(together(ball({}, 1), flipped(ball({}, 0.6))));
    EXPECT_EQ(inner_radius(*hollow, {}), 0);
    EXPECT_NEAR(inner_radius(*hollow, {0.8, 0, 0}), 0.2, 0.01);
}

TEST(Inner, TheBestOfThePartsCounts) {
    const auto mesh = [](double half) {
        return std::make_shared<const Mesh>(box({-half, -half, -half}, {half, half, half}));
    };
    const Solid::Part small{mesh(0.5), {}, {}}, large{mesh(0.8), {}, {}},
        round{{}, Element::sphere(0.6), {}},
        rounder{{}, Element::sphere(0.9), {}};
    using Parts = std::vector<Solid::Part>;
    for (const auto& [parts, best] :
         {std::pair(Parts{small, large}, 0.8), std::pair(Parts{large, small}, 0.8), std::pair(Parts{small, round}, 0.6),
          std::pair(Parts{round, large}, 0.8), std::pair(Parts{round, rounder}, 0.9),
          std::pair(Parts{rounder, round, large}, 0.9)}) {
        EXPECT_NEAR(inner_radius(*Solid::make(parts), {}), best, 1e-12);
        EXPECT_EQ(inner_radius(*Solid::make(parts), {}, 0.45), 0.45);
    }
}

TEST(Inner, TheWorstSphereIsTold) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const Sphere fine{{}, 0.5}, bad{{}, 1.25}, worse{{}, 1.5}, out{{5, 0, 0}, 0.125};
    const auto told = [&](const std::vector<Sphere>& spheres) { return certify_inner(*cube, spheres); };
    EXPECT_EQ(told({fine, bad, worse}).sphere, 2u);
    EXPECT_EQ(told({fine, worse, bad}).sphere, 1u);
    EXPECT_EQ(told({bad, bad}).sphere, 0u);
    EXPECT_NEAR(told({worse, bad}).excess, 0.5, 1e-9);
    EXPECT_EQ(told({fine, out}).excess, 0.125);
    EXPECT_TRUE(told({fine, fine}).holds);
    EXPECT_EQ(told({fine}).excess, 0);
}

TEST(Inner, TheBoundNearARimIsThatOfBiotAndSavart) {
    // Above the bottom's middle: the open top is seen as a square, of which the solid angle is known.
    const auto cube = Solid::make(open_cube());
    const auto large = Solid::make(transformed(open_cube(), {}, {64, 64, 64}));
    for (const double z : {-0.35, -0.2, 0.0, 0.1, 0.2, 0.3}) {
        const double height = 0.5 - z, winding = 1 - std::asin(0.25 / (0.25 + height * height)) / std::numbers::pi;
        const auto bound = [&](double r) { // 1/4π of the integral along four edges
            constexpr int steps = 2000;
            double sum = 0;
            for (int k = 0; k < steps; ++k) {
                const double d = std::hypot(height, 0.5, (k + 0.5) / steps - 0.5);
                sum += r / (d * (d - r)) / steps;
            }
            return sum / std::numbers::pi;
        };
        double low = 0, high = std::min(0.5, z + 0.5);
        while (high - low > 1e-9) {
            const double middle = (low + high) / 2;
            (bound(middle) < winding - 0.5 ? low : high) = middle;
        }
        const double radius = inner_radius(*cube, {0, 0, z});
        EXPECT_LE(radius, low * (z < -0.1 ? 1 + 1e-8 : 0.999))
            << "a piece of an edge counts at its nearest point; " << z;
        EXPECT_GE(radius, 0.985 * low) << z;
        EXPECT_NEAR(inner_radius(*large, {0, 0, 64 * z}, 640), 64 * radius, 1e-9) << "of any size";
    }
}

TEST(Inner, SpheresMoveToADeepPoint) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    for (const Vec3& start :
         {Vec3{2, 0.5, 1.2}, Vec3{2, 0.5, -0.2}, Vec3{2, 1.2, 0.5}, Vec3{2, -0.2, 0.6}, Vec3{-0.2, 0.5, 0.5}}) {
        const Sphere moved = shrunk_to_fit(*rod, {{start, 1}}).front();
        EXPECT_GT(moved.radius, 0.485);
        EXPECT_LT(distance(moved.center, start), 1) << "within reach";
        EXPECT_TRUE(certify_inner(*rod, std::vector<Sphere>{moved}).holds);
    }
    EXPECT_EQ(shrunk_to_fit(*rod, {{{2, 0.5, 1.2}, 0.1}}).front().radius, 0) << "out of its reach";
    EXPECT_NEAR(shrunk_to_fit(*rod, {{{2, 0.5, 1.2}, 0.3}}).front().radius, 0.1, 0.01) << "just within";
}

TEST(Inner, ContainedSpheresGo) {
    const auto cube = Solid::make(box({-2, -2, -2}, {2, 2, 2}));
    const auto radii = [&](std::vector<Sphere> spheres) {
        std::vector<double> result;
        for (const Sphere& sphere : shrunk_to_fit(*cube, std::move(spheres))) {
            result.push_back(sphere.radius);
        }
        return result;
    };
    using Radii = std::vector<double>;
    EXPECT_EQ(radii({{{}, 0.5}, {{0.25, 0, 0}, 0.25}}), (Radii{0.5, 0})) << "touches from within";
    EXPECT_EQ(radii({{{0.25, 0, 0}, 0.25}, {{}, 0.5}}), (Radii{0, 0.5}));
    EXPECT_EQ(radii({{{}, 0.5}, {{0.2500001, 0, 0}, 0.25}}), (Radii{0.5, 0.25}));
    EXPECT_EQ(radii({{{}, 0.5}, {{}, 0.5}, {{}, 0.5}}), (Radii{0.5, 0, 0})) << "the first of equal ones stays";
    EXPECT_EQ(radii({{{}, 0.5}, {{0.001, 0, 0}, 0.5}}), (Radii{0.5, 0.5}));
}

TEST(Inner, AtTheRimTheWindingNumberMustBeAboveOneHalf) {
    // In the opening of a cube it is one half; from there down it rises by 0.9003 times the depth.
    const auto cube = Solid::make(open_cube());
    const double slope = std::sqrt(8.0) / std::numbers::pi, margin = 1e-6;
    EXPECT_EQ(inner_radius(*cube, {0, 0, 0.5}), 0);
    EXPECT_EQ(inner_radius(*cube, {0, 0, 0.5 - 0.98 * margin / slope}), 0) << "rounding may say more than there is";
    EXPECT_GT(inner_radius(*cube, {0, 0, 0.5 - 1.05 * margin / slope}), 0);
}

TEST(Inner, EveryTriangleHoldsBack) {
    // Meshes of many triangles, small and large, against looking at all of them.
    Random random(12);
    for (const double scale : {1e-3, 1.0, 300.0}) {
        const Mesh mesh = transformed(torus(1, 0.4), {}, {scale, scale, scale});
        const auto solid = Solid::make(mesh);
        for (int i = 0; i < 60; ++i) {
            const double angle = random.uniform(0, 6.3), away = 1 + random.uniform(-0.25, 0.25);
            const Vec3 center = Vec3{away * std::cos(angle), away * std::sin(angle), random.uniform(-0.2, 0.2)} * scale;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Triangle& t : mesh.triangles) { // the planes of a face are no farther than the face
                for (const std::uint32_t corner : t) {
                    nearest = std::min(nearest, distance(center, mesh.vertices[corner]));
                }
            }
            const double radius = inner_radius(*solid, center, 1e6), depth = -solid->signed_distance(center);
            EXPECT_LE(radius, nearest);
            EXPECT_LE(radius, depth);
            EXPECT_GE(radius, depth - 220 * epsilon * scale);
        }
    }
}

TEST(Inner, NeedlesHoldBackToo) {
    // A triangle with corners that are all but on one line, in a cube: how far it is, is the distance to a segment.
    Random random(13);
    for (int round = 0; round < 3000; ++round) {
        const auto point = [&] {
            return Vec3{random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9)};
        };
        const Vec3 a = point(), b = point(), between = a + (b - a) * random.uniform(), center = point();
        Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
        std::array<Vec3, 3> corners{a, b, between};
        std::rotate(corners.begin(), corners.begin() + round % 3, corners.end());
        if (round % 2 == 0) {
            std::swap(corners[0], corners[1]);
        }
        mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
        mesh.triangles.push_back({8, 9, 10});
        const auto solid = Solid::make(mesh);
        const auto from = [](const Vec3& u, const Vec3& v) {
            return std::array<Quad, 3>{Quad(v.x) - u.x, Quad(v.y) - u.y, Quad(v.z) - u.z};
        };
        const auto product = [](const auto& u, const auto& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; };
        const auto line = from(a, b), way = from(a, center);
        const Quad t = std::clamp(product(line, way) / product(line, line), Quad(0), Quad(1));
        Quad square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            square += (way[axis] - t * line[axis]) * (way[axis] - t * line[axis]);
        }
        const double radius = inner_radius(*solid, center);
        EXPECT_LE(double(Quad(radius) * radius - square), 0) << round;
    }
}

TEST(Inner, SpheresThatAreNoneHaveNoRadius) {
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    for (const auto& solid :
         {Solid::make(box({-1, -1, -1}, {1, 1, 1})), primitive_solid(Element::sphere(1)),
          primitive_solid(Element::box({1, 1, 1})),
          primitive_solid(Element::cylinder(1, 1))}) {
        for (const Sphere& none :
             {Sphere{{nan, 0, 0}, 0.1}, Sphere{{0, infinity, 0}, 0.1}, Sphere{{0, 0, -infinity}, 0.1}, Sphere{{}, nan},
              Sphere{{}, infinity}, Sphere{{}, -infinity}, Sphere{{nan, nan, nan}, nan}}) {
            EXPECT_EQ(inner_radii(*solid, std::vector<Sphere>{none}).front(), 0) << none.center.x << " " << none.radius;
        }
        EXPECT_EQ(inner_radius(*solid, {}, 0.1), 0.1);
    }
}

TEST(Inner, DeepPointsStayAsTheyAre) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1.1}));
    for (const auto& [given, moved] :
         {std::pair(Sphere{{1.93, 0.47, 1.17}, 0.9}, Sphere{{1.93, 0.498125, 0.523125}, 0.498125}),
          std::pair(Sphere{{-0.1, 0.9, 0.3}, 0.7}, Sphere{{0.46875, 0.5390625, 0.475}, 0.4609375}),
          std::pair(Sphere{{4.05, 1.02, -0.01}, 0.8}, Sphere{{3.55, 0.57, 0.415}, 0.415})}) {
        const Sphere found = shrunk_to_fit(*rod, {given}).front();
        EXPECT_LT(distance(found.center, moved.center), 1e-12);
        EXPECT_NEAR(found.radius, moved.radius, 1e-12);
    }
}

TEST(Inner, NoBallReachesThroughAHole) {
    // A square hole in a cube's top: below its middle the rim is the nearest part of the surface.
    Mesh mesh = open_cube();
    for (const double half : {0.05, 0.1, 0.2}) {
        Mesh holed = mesh;
        const auto first = static_cast<std::uint32_t>(holed.vertices.size());
        for (const double size : {0.5, half}) {
            holed.vertices.insert(holed.vertices.end(),
                                  {{-size, -size, 0.5}, {size, -size, 0.5}, {size, size, 0.5}, {-size, size, 0.5}});
        }
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t next = (k + 1) % 4;
            holed.triangles.push_back({first + k, first + next, first + 4 + next});
            holed.triangles.push_back({first + k, first + 4 + next, first + 4 + k});
        }
        const auto solid = Solid::make(holed);
        for (const double depth : {0.02, 0.05, 0.1, 0.2}) {
            const double radius = inner_radius(*solid, {0, 0, 0.5 - depth}), rim = std::hypot(depth, half);
            EXPECT_LT(radius, rim * (1 - 1e-3)) << half << " " << depth;
            EXPECT_LT(solid->signed_distance({0, 0, 0.5 - depth + radius}), 0) << "its top is inside";
        }
    }
}
