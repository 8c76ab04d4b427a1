// The smallest sphere around points, where many of them lie on it.
#include <foam/base/random.hpp>
#include <foam/geometry/sphere.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace foam {
namespace {

constexpr double pi = std::numbers::pi;

/// Of a ball that holds all points, near the smallest: steps towards the farthest point (Bădoiu and Clarkson 2003).
double radius_by_steps(const std::vector<Vec3>& points) {
    Vec3 center = points.front();
    double radius = 0;
    for (int step = 1; step <= 20'000; ++step) {
        const Vec3* farthest = &points.front();
        for (const Vec3& p : points) {
            farthest = distance(center, p) > distance(center, *farthest) ? &p : farthest;
        }
        radius = distance(center, *farthest);
        center = center + (*farthest - center) / (step + 1);
    }
    return radius;
}

std::vector<Vec3> ring(int count, double radius, double height) {
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double angle = 2 * pi * k / count;
        points.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
    }
    return points;
}

void expect_smallest(const std::vector<Vec3>& points, double radius, const char* what, int count) {
    const Sphere sphere = minimum_enclosing_sphere(points);
    EXPECT_NEAR(sphere.radius, radius, 1e-6 * radius) << what << " of " << count;
    for (const Vec3& p : points) {
        EXPECT_LE(distance(p, sphere.center), sphere.radius);
    }
}

TEST(EnclosingSphere, RegularPolygonsConesAndCylinders) {
    Random random(1);
    for (int count = 3; count < 120; ++count) {
        for (int turn = 0; turn < 10; ++turn) {
            const Pose pose = Pose::from_xyz_rpy({random.uniform(-3, 3), 0, 0},
                                                 {random.uniform(-pi, pi), random.uniform(-pi, pi), 1});
            std::vector<Vec3> base = ring(count, 0.7, 0);
            std::vector<Vec3> cone = base, cylinder = base;
            cone.push_back({0, 0, 0.4});
            cone.push_back({});
            for (const Vec3& p : ring(count, 0.7, 0.4)) {
                cylinder.push_back(p);
            }
            for (auto* points : {&base, &cone, &cylinder}) {
                for (Vec3& p : *points) {
                    p = turn == 0 ? p : pose * p;
                }
                for (std::size_t i = points->size(); i > 1; --i) {
                    std::swap((*points)[i - 1], (*points)[random.below(i)]);
                }
            }
            const double of_base = 0.7; // three or more corners hold its middle
            expect_smallest(base, of_base, "polygon", count);
            expect_smallest(cone, of_base, "cone", count);
            expect_smallest(cylinder, std::hypot(0.7, 0.2), "cylinder", count);
        }
    }
}

TEST(EnclosingSphere, PointsOnGridsAndSpheres) {
    Random random(2);
    for (int k = 0; k < 60; ++k) {
        std::vector<Vec3> grid, ball;
        for (int i = 0; i < 30; ++i) {
            const auto step = [&] { return 0.1 * static_cast<double>(random.below(4)); };
            grid.push_back({step(), step(), step()});
            const double z = random.uniform(-1, 1), angle = random.uniform(0, 2 * pi), across = std::sqrt(1 - z * z);
            ball.push_back({across * std::cos(angle), across * std::sin(angle), z});
        }
        for (const auto* points : {&grid, &ball}) {
            EXPECT_LE(minimum_enclosing_sphere(*points).radius, 1.0001 * radius_by_steps(*points)) << k;
        }
    }
}

} // namespace
} // namespace foam
