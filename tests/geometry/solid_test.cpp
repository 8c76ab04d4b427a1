// Nearest points, distances, samples and what Solid::make refuses.
#include "geometry/shapes.hpp"

#include <foam/base/error.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

double length_of(const std::vector<Solid::Interval>& intervals) {
    double sum = 0;
    for (const auto& interval : intervals) {
        sum += interval.leave - interval.enter;
    }
    return sum;
}

/// Nearest distance by looking at every triangle, at points of a fine grid and by projection on edges.
double brute_distance(const Mesh& mesh, const Vec3& p) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& [ia, ib, ic] : mesh.triangles) {
        const Vec3 &a = mesh.vertices[ia], &b = mesh.vertices[ib], &c = mesh.vertices[ic];
        const Vec3 n = cross(b - a, c - a);
        const Vec3 q = p - n * (dot(p - a, n) / squared_norm(n));
        if (dot(cross(b - a, q - a), n) >= 0 && dot(cross(c - b, q - b), n) >= 0 && dot(cross(a - c, q - c), n) >= 0) {
            best = std::min(best, distance(p, q));
        }
        for (const auto& [u, v] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
            const double t = std::clamp(dot(p - u, v - u) / squared_norm(v - u), 0.0, 1.0);
            best = std::min(best, distance(p, u + (v - u) * t));
        }
    }
    return best;
}

} // namespace

/// Returns two triangles, each many times, with their own corners or shared ones.
Mesh copies_of_two(std::size_t times, bool shared) {
    Mesh mesh;
    for (std::size_t i = 0; i < times; ++i) {
        if (i == 0 || !shared) {
            mesh.vertices.insert(mesh.vertices.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
        }
        const auto first = static_cast<std::uint32_t>(shared ? 0 : 4 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first + 3, first + 1, first}); // not always from the same corner
        std::rotate(mesh.triangles.back().begin(), mesh.triangles.back().begin() + i % 3, mesh.triangles.back().end());
    }
    return mesh;
}

TEST(Solid, LooksOnceAtEachOfManyCopiesOfATriangle) {
    for (const bool shared : {false, true}) {
        const auto solid = Solid::make(copies_of_two(2000, shared));
        EXPECT_EQ(solid->surface().triangles.size(), 2u);
        EXPECT_EQ(solid->closest({0.2, 0.2, 1}).point,
                  Solid::make(copies_of_two(1, shared))->closest({0.2, 0.2, 1}).point);
    }
    EXPECT_EQ(Solid::make(copies_of_two(3, true))->surface().triangles.size(), 6u) << "few need no such look";
}

TEST(Solid, RefusesWhatIsNoSolid) {
    EXPECT_THROW(Solid::make(std::vector<Solid::Part>{}), Error);
    EXPECT_THROW(Solid::make(Mesh{}), Error);
    Mesh bad = box({0, 0, 0}, {1, 1, 1});
    bad.vertices[3].y = std::nan("");
    EXPECT_THROW(Solid::make(bad), Error);
    bad = box({0, 0, 0}, {1, 1, 1});
    bad.triangles[3][1] = 99;
    EXPECT_THROW(Solid::make(bad), Error);
    EXPECT_THROW(primitive_solid(Element::sphere(-1)), Error);
    EXPECT_THROW(primitive_solid(Element::box({1, 0, 1})), Error);
}

TEST(Solid, UnitCube) {
    const auto solid = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    EXPECT_DOUBLE_EQ(solid->area(), 6);
    EXPECT_DOUBLE_EQ(solid->volume(), 1);
    EXPECT_TRUE(solid->closed());
    EXPECT_TRUE(solid->contains({0.5, 0.5, 0.5}));
    EXPECT_TRUE(solid->contains({0, 0, 0})) << "the surface belongs to the solid";
    EXPECT_TRUE(solid->contains({1, 1, 1}));
    EXPECT_TRUE(solid->contains({0.5, 1, 0.5}));
    EXPECT_TRUE(solid->contains({0.5, 0.5, 1}));
    EXPECT_FALSE(solid->contains({0.5, 0.5, 1 + 1e-12}));
    EXPECT_FALSE(solid->contains({0.5, 0.5, -1}));
    EXPECT_DOUBLE_EQ(solid->signed_distance({0.5, 0.5, 0.75}), -0.25);
    EXPECT_DOUBLE_EQ(solid->signed_distance({2, 0.5, 0.5}), 1);
    const SurfacePoint near = solid->closest({0.4, 0.3, 1.5});
    EXPECT_LT(distance(near.point, {0.4, 0.3, 1}), 1e-15);
    EXPECT_EQ(near.normal, (Vec3{0, 0, 1}));
    EXPECT_DOUBLE_EQ(length_of(solid->inside_along({-1, 0.5, 0.5}, {2, 0, 0})), 0.5);
    EXPECT_TRUE(solid->inside_along({-1, 2, 0.5}, {1, 0, 0}).empty());
}

TEST(Solid, LinesThroughEdgesAndCorners) {
    const auto solid = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    // The diagonal meets corners only, and the faces' diagonals run along edges of the triangulation.
    EXPECT_NEAR(length_of(solid->inside_along({-1, -1, -1}, {1, 1, 1})), 1, 1e-9);
    EXPECT_NEAR(length_of(solid->inside_along({-1, -1, 0.5}, {1, 1, 0})), 1, 1e-9);
    EXPECT_NEAR(length_of(solid->inside_along({0.5, 0.5, -3}, {0, 0, 1})), 1, 1e-9);
    for (const double x : {0.0, 1.0}) { // in a face or along an edge: inside or not, but never beyond the cube
        for (const double y : {0.0, 0.5, 1.0}) {
            const auto intervals = solid->inside_along({x, y, -1}, {0, 0, 1});
            ASSERT_LE(intervals.size(), 1u);
            EXPECT_LE(length_of(intervals), 1 + 1e-9);
        }
    }
}

TEST(Solid, ClosestAgreesWithEveryTriangle) {
    Random random(3);
    for (const Mesh& mesh : {ball({0.1, 0, 0}, 0.5, 9), torus(1, 0.3, 13), box({0, 0, 0}, {1, 2, 1e-3})}) {
        const auto solid = Solid::make(mesh);
        for (int i = 0; i < 300; ++i) {
            const Vec3 p = random_point(random, enlarged(solid->bounds(), 0.5));
            const SurfacePoint q = solid->closest(p);
            EXPECT_NEAR(distance(p, q.point), brute_distance(mesh, p), 1e-12);
            EXPECT_NEAR(std::abs(solid->signed_distance(p)), distance(p, q.point), 1e-15);
        }
    }
}

TEST(Solid, DegenerateTrianglesAreSurfaceAndDoNoHarm) {
    Mesh mesh = box({0, 0, 0}, {1, 1, 1});
    mesh.vertices.push_back({3, 0, 0});
    mesh.vertices.push_back({5, 0, 0});
    mesh.vertices.push_back({4, 0, 0});
    mesh.triangles.push_back({8, 8, 8});
    mesh.triangles.push_back({8, 9, 10}); // collinear
    mesh.triangles.push_back({8, 9, 9});
    const auto solid = Solid::make(mesh);
    EXPECT_TRUE(solid->closed());
    EXPECT_NEAR(solid->volume(), 1, 1e-12);
    EXPECT_NEAR(solid->signed_distance({4.5, 1, 0}), 1, 1e-12);
    EXPECT_EQ(solid->closest({4.5, 1, 0}).normal, Vec3{});
    EXPECT_FALSE(solid->contains({4.5, 1, 0}));
    EXPECT_TRUE(solid->contains({0.5, 0.5, 0.5}));
}

TEST(Solid, VerticesOfNoTriangleDoNotCount) {
    const Mesh used = box({0, 0, 0}, {1, 1, 1});
    Mesh mesh = used;
    mesh.vertices.insert(mesh.vertices.begin() + 3, {0, 0, 1e155});
    mesh.vertices.push_back({5, 6, 7});
    for (Triangle& triangle : mesh.triangles) {
        for (std::uint32_t& corner : triangle) {
            corner += corner >= 3 ? 1 : 0;
        }
    }
    const auto solid = Solid::make(mesh);
    EXPECT_EQ(solid->surface(), Solid::make(used)->surface());
    EXPECT_EQ(*solid->parts()[0].mesh, used);
}

TEST(Solid, SamplesAreUniformByAreaAndRepeatable) {
    const auto solid = Solid::make(box({0, 0, 0}, {1, 2, 3}));
    const auto points = solid->sample_surface(22'000, 5);
    ASSERT_EQ(points.size(), 22'000u);
    std::size_t top = 0;
    for (const SurfacePoint& p : points) {
        EXPECT_LT(std::abs(solid->signed_distance(p.point)), 1e-12);
        EXPECT_NEAR(norm(p.normal), 1, 1e-12);
        top += p.normal.z == 1;
    }
    EXPECT_NEAR(static_cast<double>(top), 2000, 2); // 2 m² of 22 m², stratified
    const auto again = solid->sample_surface(22'000, 5);
    EXPECT_EQ(points[777].point, again[777].point);
    EXPECT_NE(points[777].point, solid->sample_surface(22'000, 6)[777].point);
    EXPECT_TRUE(solid->sample_surface(0, 1).empty());
}

TEST(Solid, QueriesMoveWithTheSolid) {
    Random random(8);
    const Mesh mesh = torus(0.4, 0.1, 20);
    const auto solid = Solid::make(mesh);
    for (int k = 0; k < 5; ++k) {
        const Pose pose = random_pose(random, k == 0 ? 10'000 : 3);
        const auto moved = Solid::make(transformed(mesh, pose));
        const double tolerance = k == 0 ? 1e-8 : 1e-12;
        EXPECT_NEAR(moved->volume(), solid->volume(), tolerance);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = random_point(random, solid->bounds());
            EXPECT_NEAR(moved->signed_distance(pose * p), solid->signed_distance(p), tolerance);
        }
    }
}

TEST(Solid, TinyAndHugeCoordinates) {
    for (const double scale : {1e-7, 1e30}) {
        const auto solid = Solid::make(transformed(ball({}, 1, 12), {}, {scale, scale, scale}));
        EXPECT_TRUE(solid->contains({}));
        EXPECT_FALSE(solid->contains({1.01 * scale, 0, 0}));
        EXPECT_NEAR(solid->signed_distance({2 * scale, 0, 0}) / scale, 1, 0.01);
        EXPECT_NEAR(solid->volume() / (scale * scale * scale), 4.1, 0.1);
    }
}

TEST(Solid, SignedDistanceDoesNotDependOnTheOrderOfParts) {
    const auto large = std::make_shared<const Mesh>(box({0, 0, 0}, {1, 1, 1}));
    const auto small = std::make_shared<const Mesh>(box({0.6, 0.4, 0.4}, {0.8, 0.6, 0.6}));
    const Vec3 p{0.5, 0.5, 0.5}; // half a metre inside the large box, 0.1 m outside the small one
    for (const bool large_first : {true, false}) {
        std::vector<Solid::Part> parts{{large, std::nullopt, {}}, {small, std::nullopt, {}}};
        if (!large_first) {
            std::swap(parts[0], parts[1]);
        }
        EXPECT_DOUBLE_EQ(Solid::make(std::move(parts))->signed_distance(p), -0.5) << large_first;
    }
}

TEST(Solid, OffsetsOfParts) {
    const auto mesh = std::make_shared<const Mesh>(box({0, 0, 0}, {1, 1, 1}));
    const auto solid = Solid::make(std::vector<Solid::Part>{
        {mesh, std::nullopt, {}},
        {nullptr, Element::sphere(0.5), Pose::from_xyz_rpy({4, 0, 0}, {})}});
    const auto offsets = solid->part_offsets();
    ASSERT_EQ(offsets.size(), 3u);
    EXPECT_EQ(offsets[1], 12u);
    EXPECT_EQ(offsets[2], solid->surface().triangles.size());
    EXPECT_GE(solid->closest({5, 0, 0}).triangle, 12u);
    EXPECT_LT(solid->closest({-1, 0, 0}).triangle, 12u);
    EXPECT_DOUBLE_EQ(solid->signed_distance({5, 0, 0}), 0.5) << "primitives are exact";
}
