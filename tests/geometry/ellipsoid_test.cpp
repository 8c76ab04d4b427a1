// Ellipsoids against what is known of them in long double: distances, proofs, growth, and the solid that is one.
#include "geometry/plain_shapes.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/volumes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace foam {
namespace {

using Real = long double;

Element some_ellipsoid(Random& random) {
    const auto length = [&] { return std::exp(random.uniform(-2, 1)); };
    return moved(Element::ellipsoid({length(), length(), length()}), test::random_pose(random, 2));
}

/// Returns Σ (qᵢ / aᵢ)² of a point in the frame of the ellipsoid: at most 1 inside.
Real reach(const Element& e, const Vec3& p) {
    const auto& r = e.pose.rotation;
    Real sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        Real q = 0;
        for (int k = 0; k < 3; ++k) {
            q += Real(r[static_cast<std::size_t>(k)][axis]) * (Real(p[k]) - Real(e.pose.translation[k]));
        }
        sum += q / Real(e.half[axis]) * (q / Real(e.half[axis]));
    }
    return sum;
}

TEST(Ellipsoid, SignedDistanceIsThatOfTheNearestPoint) {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const Element e = some_ellipsoid(random);
        // A point off the surface along its normal is as far off, as long as the ellipsoid is not curved more.
        const Vec3 n = test::random_direction(random), on = support(e, n);
        const double least = std::min({e.half.x, e.half.y, e.half.z}), most = std::max({e.half.x, e.half.y, e.half.z});
        for (const double away : {2.0, 0.1, 1e-6, -0.9 * least * least / most}) {
            EXPECT_NEAR(signed_distance(e, on + n * away), away, 1e-12 * (1 + most)) << away;
        }
        EXPECT_NEAR(signed_distance(e, e.pose.translation), -least, 1e-12) << "from the middle to the nearest end";
        EXPECT_EQ(holds(e, on + n * 1e-9), false);
        EXPECT_EQ(holds(e, on - n * 1e-9), true);
    }
    const Element ball = Element::ellipsoid({2, 2, 2});
    EXPECT_NEAR(signed_distance(ball, {3, 4, 0}), 3, 1e-14);
    EXPECT_NEAR(signed_distance(ball, {0, 0, 0}), -2, 1e-14);
}

TEST(Ellipsoid, LinesMeshesAndSurfacesAreItsOwn) {
    Random random(2);
    for (int round = 0; round < 100; ++round) {
        const Element e = some_ellipsoid(random);
        const Vec3 from = test::random_point(random, bounds(e)), along = test::random_direction(random);
        if (const auto part = inside_along(e, from, along)) {
            EXPECT_NEAR(static_cast<double>(reach(e, from + along * part->enter)), 1, 1e-9);
            EXPECT_NEAR(static_cast<double>(reach(e, from + along * part->leave)), 1, 1e-9);
        } else {
            EXPECT_GT(reach(e, from), 1);
        }
        const Mesh mesh = enclosing_mesh(e, 32);
        EXPECT_TRUE(topology(mesh).closed());
        for (const Vec3& v : mesh.vertices) {
            EXPECT_GE(reach(e, v), 1);
        }
        EXPECT_NEAR(signed_volume(mesh), volume(e), 0.03 * volume(e));
    }
}

/// Triangles near the surface: whatever the proof calls covered lies inside.
TEST(Ellipsoid, NoTriangleThatReachesOutIsProved) {
    Random random(3);
    int held = 0, open = 0;
    for (int round = 0; round < 2000; ++round) {
        const Element e = some_ellipsoid(random);
        Mesh mesh;
        Real farthest = 0;
        for (int k = 0; k < 3; ++k) {
            const double share = 1 + random.uniform(-1, 1) * std::pow(10.0, -random.uniform(3, 15));
            const Vec3 on = support(e, test::random_direction(random));
            mesh.vertices.push_back(e.pose.translation + (on - e.pose.translation) * share);
            farthest = std::max(farthest, reach(e, mesh.vertices.back()));
        }
        mesh.triangles = {{0, 1, 2}};
        const bool proved = certify(*Solid::make(mesh), Elements(std::vector{e})).holds;
        ASSERT_TRUE(!proved || farthest <= 1) << round << ": " << static_cast<double>(farthest - 1);
        if (farthest < 1 - 1e-11L) {
            EXPECT_TRUE(proved) << round << ": " << static_cast<double>(farthest - 1);
        }
        held += proved;
        open += !proved;
    }
    EXPECT_GT(held, 100);
    EXPECT_GT(open, 100);
}

TEST(Ellipsoid, GapsBetweenTwoAreFound) {
    const Mesh bar = test::box({-1.9, -0.05, -0.05}, {1.9, 0.05, 0.05});
    const auto two = [](double apart) {
        Element left = Element::ellipsoid({1.2, 0.5, 0.4}), right = left;
        left.pose.translation.x = -apart;
        right.pose.translation.x = apart;
        return Elements(std::vector{left, right});
    };
    EXPECT_TRUE(certify(*Solid::make(bar), two(1.0)).holds);
    const Certificate missed = certify(*Solid::make(bar), two(1.25));
    EXPECT_FALSE(missed.holds);
    EXPECT_LT(std::abs(missed.witness.x), 0.1);
    EXPECT_GT(missed.growth, 0);
}

TEST(Ellipsoid, GrowsUntilItCovers) {
    Random random(4);
    for (int round = 0; round < 40; ++round) {
        const Mesh mesh = transformed(test::box({-1, -0.3, -0.2}, {1, 0.3, 0.2}), test::random_pose(random, 1));
        const auto solid = Solid::make(mesh);
        std::vector<Element> few{some_ellipsoid(random), some_ellipsoid(random)};
        for (Element& e : few) {
            e.pose.translation = test::random_point(random, bounds(mesh));
        }
        const Elements grown = grown_to_cover(*solid, Elements(few));
        EXPECT_TRUE(certify(*solid, grown).holds);
        for (const Vec3& v : mesh.vertices) {
            EXPECT_TRUE(std::any_of(grown.begin(), grown.end(), [&](const Element& e) { return reach(e, v) <= 1; }));
        }
    }
}

TEST(Ellipsoid, GrownItHoldsAllWithinTheLength) {
    Random random(5);
    for (int round = 0; round < 200; ++round) {
        const Element e = some_ellipsoid(random);
        const double length = std::exp(random.uniform(-20, 1));
        const Element larger = grown(e, length);
        for (int k = 0; k < 20; ++k) {
            const Vec3 n = test::random_direction(random);
            EXPECT_LE(reach(larger, support(e, n) + n * length), 1 + 1e-13L);
        }
    }
}

/// The least ellipsoid about the same centre that holds an ellipsoid and a point is longer towards the point, in units in which
/// the first is a ball, and no wider.
TEST(Ellipsoid, GrowsTowardsAPointByTheLeast) {
    Random random(6);
    for (int round = 0; round < 300; ++round) {
        Element e = some_ellipsoid(random);
        const bool slender = round % 3 == 0;
        e.half.x *= slender ? 1e-4 : 1;
        const Vec3 n = test::random_direction(random);
        const double length = random.uniform(1.1, 3);
        const Vec3 point = e.pose * (Vec3{n.x * e.half.x, n.y * e.half.y, n.z * e.half.z} * length);
        const Mesh speck{{point, point, point}, {{0, 1, 2}}};
        const Element larger = grown_to_cover(*Solid::make(speck), Elements(std::vector{e}))[0];
        EXPECT_LE(reach(larger, point), 1);
        EXPECT_NEAR(volume(larger) / volume(e), length, slender ? 1e-5 : 1e-8);
        for (int k = 0; k < 50; ++k) {
            EXPECT_LE(reach(larger, support(e, test::random_direction(random))), 1) << round;
        }
    }
}

TEST(Ellipsoid, ItsExposedAreaIsThatOfItsSurface) {
    const Element e = Element::ellipsoid({0.3, 0.2, 0.1});
    const Mesh mesh = enclosing_mesh(e, 400);
    double area = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
        const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        area += norm(cross(b - a, c - a)) / 2;
    }
    const auto inside = Solid::make(test::ball({0, 0, 0}, 0.05, 8));
    EXPECT_NEAR(measure(*inside, Elements(std::vector{e})).exposed_area, area, 5e-3 * area);
}

/// The same solid as a primitive and as a mesh around it.
TEST(Ellipsoid, IsASolid) {
    const Pose pose = Pose::from_xyz_rpy({0.1, -0.2, 0.3}, {0.5, 1, -0.4});
    const Element own = Element::ellipsoid({0.3, 0.2, 0.1});
    const auto solid = test::primitive_solid(own, pose);
    const double exact = 4.0 / 3 * std::numbers::pi * 0.006;
    EXPECT_NEAR(solid->volume(), exact, 1e-15);
    EXPECT_TRUE(solid->closed());
    EXPECT_NEAR(solid->signed_distance(pose * Vec3{0.5, 0, 0}), 0.2, 1e-12);
    EXPECT_TRUE(certify(*solid, Elements(std::vector{moved(own, pose)})).holds) << "by its lengths";
    Element less = moved(own, pose);
    less.half.y *= 1 - 1e-6;
    const Certificate missed = certify(*solid, Elements(std::vector{less}));
    EXPECT_FALSE(missed.holds);
    EXPECT_GT(missed.growth, 1e-8);
    // Other elements have to hold the mesh around it, too.
    std::vector<Sphere> one{{pose.translation, 0.3 * (1 + 4e-3)}};
    EXPECT_TRUE(certify(*solid, one).holds);
    one[0].radius = 0.3 * (1 - 1e-5);
    EXPECT_FALSE(certify(*solid, one).holds);
    const auto mass = mass_properties(*solid, 1000);
    ASSERT_TRUE(mass);
    EXPECT_NEAR(mass->mass, 1000 * exact, 1e-9);
    EXPECT_NEAR(mass->inertia[0] + mass->inertia[1] + mass->inertia[2],
                2 * mass->mass / 5 * (0.09 + 0.04 + 0.01), 1e-9);
}

/// A ball in an ellipsoid is known in closed form, as far as the least half axis goes.
TEST(Ellipsoid, HoldsABallNoLargerThanItsLeastHalfAxis) {
    const Pose pose = Pose::from_xyz_rpy({0.1, -0.2, 0.3}, {0.5, 1, -0.4});
    const Elements own(std::vector{moved(Element::ellipsoid({0.3, 0.2, 0.1}), pose)});
    const auto is_held = [&](double radius, const Vec3& at) {
        Pose there = pose;
        there.translation = pose * at;
        return certify(*test::primitive_solid(Element::sphere(radius), there), own).holds;
    };
    for (const double radius : {0.01, 0.05, 0.1 * (1 - 1e-9)}) {
        EXPECT_TRUE(is_held(radius, {})) << radius;
    }
    for (const double radius : {0.1 * (1 + 1e-9), 0.15, 0.2, 0.25, 0.3, 0.5, 2.0}) {
        EXPECT_FALSE(is_held(radius, {})) << radius;
    }
    for (const double radius : {0.01, 0.03, 0.05}) { // the ball of half the size about the place lies in it
        EXPECT_TRUE(is_held(radius, {0.15 * (1 - 1e-9), 0, 0})) << radius;
    }
    EXPECT_FALSE(is_held(0.05, {0, 0, 0.05 * (1 + 1e-9)}));
    EXPECT_FALSE(is_held(0.05, {0, 0.2, 0}));
}

/// Thin plates on the facets of the polyhedron around it do not hold the surface beneath.
TEST(Ellipsoid, IsNotHeldByPlatesOnTheFacetsAroundIt) {
    const auto solid = test::primitive_solid(Element::ellipsoid({0.3, 0.25, 0.2}), {});
    const Mesh& facets = solid->surface();
    std::vector<Element> plates;
    for (const auto& [i, j, k] : facets.triangles) {
        const Vec3 &a = facets.vertices[i], &b = facets.vertices[j], &c = facets.vertices[k];
        const Vec3 x = normalized(b - a), z = normalized(cross(b - a, c - a)), y = cross(z, x);
        Element plate = Element::box({0.1, 0.1, 1e-9});
        plate.pose.rotation = {Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}};
        plate.pose.translation = (a + b + c) / 3;
        plates.push_back(plate);
    }
    const Certificate refused = certify(*solid, Elements(plates));
    EXPECT_FALSE(refused.holds);
    EXPECT_TRUE(certify(*as_surface(*Solid::make(facets)), Elements(plates)).holds) << "the facets themselves";
}

} // namespace
} // namespace foam
