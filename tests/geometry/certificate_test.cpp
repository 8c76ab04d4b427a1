// The proof of cover: it must hold where it can, and never where a point is uncovered.
#include "geometry/shapes.hpp"

#include <foam/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

/// Distance to the union of the spheres, by looking at each.
double gap_at(const Vec3& p, const std::vector<Sphere>& spheres) {
    double gap = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres) {
        gap = std::min(gap, distance(p, s.center) - s.radius);
    }
    return std::max(gap, 0.0);
}

Mesh triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    return {{a, b, c}, {{0, 1, 2}}};
}

} // namespace

TEST(Certificate, OneSphere) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double radius = std::sqrt(3.0);
    EXPECT_TRUE(certify(*cube, std::vector<Sphere>{{{}, radius + 1e-9}}).holds);
    const Certificate missed = certify(*cube, std::vector<Sphere>{{{}, radius - 1e-9}});
    EXPECT_FALSE(missed.holds);
    EXPECT_NEAR(missed.growth, 1e-9, 1e-11);
    EXPECT_NEAR(norm(missed.witness), radius, 1e-6);
    EXPECT_LT(missed.triangle, 12u);
}

TEST(Certificate, AnUlpTooSmallFails) {
    // The corners lie exactly on the sphere of radius 3: (1, 2, 2) and its likes.
    const auto solid = Solid::make(triangle({1, 2, 2}, {2, 1, 2}, {2, 2, 1}));
    EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{{}, std::nextafter(3.0, 0.0)}}).holds);
    EXPECT_TRUE(certify(*solid, std::vector<Sphere>{{{}, 3 * (1 + 1e-12)}}).holds);
}

TEST(Certificate, SeveralSpheresTogether) {
    const auto rod = Solid::make(box({0, 0, 0}, {4, 1, 1}));
    std::vector<Sphere> spheres;
    for (int i = 0; i < 8; ++i) {
        spheres.push_back({{0.25 + 0.5 * i, 0.5, 0.5}, 0.75 + 1e-9});
    }
    EXPECT_TRUE(certify(*rod, spheres).holds) << "though the spheres meet exactly on the edges";
    spheres[3].radius = 0.7;
    const Certificate missed = certify(*rod, spheres);
    EXPECT_FALSE(missed.holds);
    EXPECT_GT(gap_at(missed.witness, spheres), 0);
    EXPECT_GE(missed.growth, gap_at(missed.witness, spheres));
}

TEST(Certificate, PinHole) {
    // Three discs in the plane whose common point is a hair outside all of them.
    const auto solid = Solid::make(triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0}));
    for (const double hole : {1e-3, 1e-6, 1e-9}) {
        std::vector<Sphere> spheres;
        for (int k = 0; k < 3; ++k) {
            const double angle = 2 * std::numbers::pi * k / 3 + 0.3;
            spheres.push_back({2 * Vec3{std::cos(angle), std::sin(angle), 0}, 2 - hole});
        }
        const Certificate missed = certify(*solid, spheres);
        EXPECT_FALSE(missed.holds) << hole;
        EXPECT_GE(missed.growth, hole * (1 - 1e-4));
        for (Sphere& s : spheres) {
            s.radius = 2 + hole;
        }
        EXPECT_TRUE(certify(*solid, spheres).holds) << hole;
    }
}

TEST(Certificate, OverlapsOfAHairTakeFewPieces) {
    // A strip under a row of balls, and the corners of a square under four that meet in its middle.
    const auto strip = Solid::make(box({0, 0, 0}, {8, 0.5, 0}));
    std::vector<Sphere> row, four;
    for (int i = 0; i < 8; ++i) {
        row.push_back({{i + 0.5, 0.25, 0}, std::hypot(0.5, 0.25) * (1 + 1e-9)});
    }
    const Certificate along = certify(*strip, row);
    EXPECT_TRUE(along.holds);
    EXPECT_LT(along.pieces, 400u) << "halving goes down to the width of the overlap";
    const auto square = Solid::make(box({-1, -1, 0}, {1, 1, 0}));
    for (int k = 0; k < 4; ++k) {
        four.push_back({{k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, 0}, std::sqrt(0.5) * (1 + 1e-9)});
    }
    const Certificate around = certify(*square, four);
    EXPECT_TRUE(around.holds);
    EXPECT_LT(around.pieces, 100u);
}

TEST(Certificate, GrowthIsTheGap) {
    Random random(4);
    for (int round = 0; round < 20; ++round) {
        const auto solid = Solid::make(torus(1, 0.3, 10));
        std::vector<Sphere> spheres;
        for (int i = 0; i < 8; ++i) {
            spheres.push_back({random_point(random, solid->bounds()), random.uniform(0.2, 0.8)});
        }
        double sampled = 0;
        for (const SurfacePoint& p : solid->sample_surface(20'000, 1)) {
            sampled = std::max(sampled, gap_at(p.point, spheres));
        }
        const Certificate certificate = certify(*solid, spheres);
        if (sampled > 0) {
            EXPECT_FALSE(certificate.holds);
            EXPECT_GE(certificate.growth, sampled);
            EXPECT_LE(certificate.growth, sampled * 1.05 + 0.01);
            for (Sphere& s : spheres) {
                s.radius += certificate.growth * (1 + 1e-9) + 1e-9;
            }
            EXPECT_TRUE(certify(*solid, spheres).holds) << "growth by so much closes everything";
        }
    }
}

TEST(Certificate, NeverPassesAnUncoveredSample) {
    // Spheres around a random cut of the surface, their radii around what just covers it.
    Random random(7);
    int held = 0;
    for (int round = 0; round < 200; ++round) {
        const Pose pose = random_pose(random, round % 2 ? 10'000 : 1);
        const auto solid = Solid::make(transformed(box({0, 0, 0}, {1, 0.2, 0.3}), pose));
        std::vector<Sphere> spheres;
        for (int i = 0; i < 4; ++i) {
            spheres.push_back({pose * Vec3{(i + 0.5) / 4, 0.1, 0.15}, 0.2195 + random.uniform(-1e-3, 1e-3)});
        }
        const bool holds = certify(*solid, spheres).holds;
        held += holds;
        for (const SurfacePoint& p : solid->sample_surface(2000, static_cast<std::uint64_t>(round))) {
            EXPECT_TRUE(!holds || gap_at(p.point, spheres) <= 1e-15 * norm(pose.translation));
        }
        for (const Vec3& v : solid->surface().vertices) {
            EXPECT_TRUE(!holds || gap_at(v, spheres) == 0);
        }
    }
    EXPECT_GT(held, 20);
    EXPECT_LT(held, 180);
}

TEST(Certificate, SpheresThatAreNone) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(certify(*cube, {}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, -5}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, 0}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{}, nan}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{nan, 0, 0}, 5}}).holds);
    EXPECT_FALSE(certify(*cube, std::vector<Sphere>{{{infinity, 0, 0}, infinity}}).holds);
    EXPECT_TRUE(certify(*cube, std::vector<Sphere>{{{nan, 0, 0}, 5}, {{}, 2}, {{}, nan}}).holds);
}

TEST(Certificate, DegenerateTrianglesMustBeCoveredToo) {
    Mesh mesh = box({-1, -1, -1}, {1, 1, 1});
    mesh.vertices.push_back({3, 0, 0});
    mesh.triangles.push_back({8, 8, 8});
    EXPECT_FALSE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 2}}).holds);
    EXPECT_TRUE(certify(*Solid::make(mesh), std::vector<Sphere>{{{}, 2}, {{3, 0, 0}, 0.1}}).holds);
}

TEST(Certificate, SmallAndFarParts) {
    for (const double scale : {1e-7, 1.0}) {
        Pose pose;
        pose.translation = scale < 1 ? Vec3{} : Vec3{1e4, 0, 0};
        const auto solid = Solid::make(transformed(box({-1, -1, -1}, {1, 1, 1}), pose, {scale, scale, scale}));
        const double radius = std::sqrt(3.0) * scale;
        EXPECT_TRUE(certify(*solid, std::vector<Sphere>{{pose.translation, radius * (1 + 1e-10)}}).holds);
        EXPECT_FALSE(certify(*solid, std::vector<Sphere>{{pose.translation, radius * (1 - 1e-10)}}).holds);
    }
}

TEST(Certificate, ASphereCoversItsPrimitive) {
    const Pose pose = Pose::from_xyz_rpy({0.1, 0.2, 0.3}, {0.4, 0.5, 0.6});
    const auto ball = primitive_solid({Primitive::Kind::sphere, {}, 0.25, 0}, pose);
    EXPECT_TRUE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.3}, 0.25}}).holds) << "proved in closed form";
    EXPECT_FALSE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.3}, std::nextafter(0.25, 0)}}).holds);
    EXPECT_TRUE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.4}, 0.35 + 1e-9}}).holds);
    EXPECT_FALSE(certify(*ball, std::vector<Sphere>{{{0.1, 0.2, 0.4}, 0.35 - 1e-9}}).holds);
    const auto capsule = primitive_solid({Primitive::Kind::capsule, {}, 0.25, 1});
    EXPECT_TRUE(certify(*capsule, std::vector<Sphere>{{{}, 0.75 + 1e-9}}).holds);
    EXPECT_FALSE(certify(*capsule, std::vector<Sphere>{{{}, 0.75 - 1e-9}}).holds);
}
