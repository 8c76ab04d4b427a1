// Queries on a rod of needles, which has an index of its own.
#include "geometry/rod_of_needles.hpp"

#include <foam/base/random.hpp>
#include <foam/geometry/solid.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test::needles;

TEST(NeedleSolid, FindsWhatLookingAtEachTriangleFinds) {
    const Mesh mesh = rod();
    const std::vector<geometry::Corners> triangles = corners_of(mesh);
    const auto solid = Solid::make(mesh);
    Random random(7);
    for (int k = 0; k < 2000; ++k) {
        const double reach = k % 2 == 0 ? 1.5 : 400;
        const Vec3 local{random.uniform(-60, 60), random.uniform(-reach, reach), random.uniform(-reach, reach)};
        const Vec3 p = placed(local.x, local.y, local.z);
        double nearest = 1e300;
        for (const geometry::Corners& t : triangles) {
            nearest = std::min(nearest, distance(geometry::closest_on_triangle(t, p), p));
        }
        EXPECT_NEAR(distance(solid->closest(p).point, p), nearest, 1e-11) << k; // coordinates of 400 are rounded
        const double from_axis = std::hypot(local.y, local.z);
        if (std::abs(from_axis - rod_radius) > 1e-3 && std::abs(std::abs(local.x) - rod_length / 2) > 1e-3) {
            EXPECT_EQ(solid->contains(p), from_axis < rod_radius && std::abs(local.x) < rod_length / 2) << k;
        }
    }
}
