// The triangles of convex hulls, in whole numbers.
#include "plain_shapes.hpp"

#include <foam/geometry/internal/quickhull.hpp>

#include <gtest/gtest.h>

#include <set>

using namespace foam;

namespace {

using Lattice = std::array<std::int64_t, 3>;
constexpr double unit = 64; // coordinates are whole multiples of 1 / 64, up to 1

/// Six times the signed volume of a tetrahedron.
std::int64_t six_volumes(const Lattice& a, const Lattice& b, const Lattice& c, const Lattice& d) {
    std::array<Lattice, 3> m{};
    for (std::size_t k = 0; k < 3; ++k) {
        m[0][k] = b[k] - a[k];
        m[1][k] = c[k] - a[k];
        m[2][k] = d[k] - a[k];
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

struct Points {
    std::vector<Lattice> whole;
    std::vector<Vec3> real;

    void add(const Lattice& p) {
        whole.push_back(p);
        real.push_back({static_cast<double>(p[0]) / unit, static_cast<double>(p[1]) / unit, static_cast<double>(p[2]) / unit});
    }
};

Points at_random(Random& random, std::size_t count, std::int64_t half) {
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        Lattice p{};
        for (std::int64_t& x : p) {
            x = static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(2 * half + 1))) - half;
        }
        points.add(p);
    }
    return points;
}

/// Expects that the triangles are a closed surface around all points, and that each knows its plane. Returns six times the
/// volume in it.
std::int64_t expect_hull(const Points& points, const std::vector<HullTriangle>& triangles, double size) {
    std::int64_t volume = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const HullTriangle& t = triangles[i];
        const std::array<Lattice, 3> c{points.whole[t.corners[0]], points.whole[t.corners[1]], points.whole[t.corners[2]]};
        for (const Lattice& p : points.whole) {
            EXPECT_LE(six_volumes(c[0], c[1], c[2], p), 0) << "a point is outside";
        }
        volume += six_volumes({0, 0, 0}, c[0], c[1], c[2]);
        for (std::size_t k = 0; k < 3; ++k) { // beyond each edge is a triangle that has it the other way round
            if (t.across[k] >= triangles.size()) {
                ADD_FAILURE() << "there is no such triangle";
                continue;
            }
            const HullTriangle& beyond = triangles[t.across[k]];
            bool found = false;
            for (std::size_t m = 0; m < 3; ++m) {
                found = found || (beyond.across[m] == i && beyond.corners[m] == t.corners[(k + 1) % 3] &&
                                  beyond.corners[(m + 1) % 3] == t.corners[k]);
            }
            EXPECT_TRUE(found);
        }
        EXPECT_EQ(t.at, points.real[t.corners[0]]);
        const Vec3 v = points.real[t.corners[1]] - t.at, w = points.real[t.corners[2]] - t.at, n = cross(v, w);
        if (norm(n) > 0) {
            EXPECT_LE(foam::distance(t.normal, n / norm(n)), 1e-15);
            // Above the error of the normal and of a distance, of less than twice as much by other roundings.
            const double least = size * geometry::unit_roundoff * (8 * norm(v) * norm(w) / norm(n) + 4);
            EXPECT_GT(t.error, 1.5 * least);
            EXPECT_LT(t.error, 5 * least);
        }
    }
    return volume;
}

TEST(Quickhull, IsAClosedSurfaceAroundAllPoints) {
    Random random(1);
    for (int round = 0; round < 300; ++round) {
        const Points points = at_random(random, 4 + random.below(40), round % 3 == 0 ? 2 : round % 3 == 1 ? 8 : 64);
        Quickhull hull(points.real, 4, 1e-12);
        std::int64_t most = 0; // whether there is a volume
        for (std::size_t i = 0; i < 4 && most == 0; ++i) {
            for (std::size_t k = i; k < points.whole.size() && most == 0; ++k) {
                for (std::size_t m = k; m < points.whole.size() && most == 0; ++m) {
                    for (std::size_t n = m; n < points.whole.size() && most == 0; ++n) {
                        most = std::abs(six_volumes(points.whole[i], points.whole[k], points.whole[m], points.whole[n]));
                    }
                }
            }
        }
        const bool has_volume = hull.run();
        ASSERT_EQ(has_volume, most > 0);
        if (!has_volume) {
            continue;
        }
        const std::int64_t volume = expect_hull(points, hull.triangles(), 4);
        EXPECT_NEAR(hull.volume(), static_cast<double>(volume) / 6 / (unit * unit * unit), 1e-12);
        // Corner by corner it grows to the same volume, and never above.
        Quickhull slow(points.real, 4, 1e-12);
        ASSERT_TRUE(slow.begin());
        double before = slow.volume();
        EXPECT_GT(before, 0);
        while (slow.grow()) {
            EXPECT_GT(slow.volume(), before);
            before = slow.volume();
        }
        EXPECT_NEAR(before, hull.volume(), 1e-12);
        EXPECT_FALSE(slow.grow());
    }
}

TEST(Quickhull, WhatIsOutsideByLessThanTheToleranceIsNoCorner) {
    const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
    for (const double beside : {0.9e-6, 1.1e-6}) {
        std::vector<Vec3> points = cube;
        points.push_back({0.4, 0.5, -beside});
        points.push_back({0.3, 0.3, 0.3}); // well inside
        points.push_back(points[3]);       // a corner twice
        Quickhull hull(points, 2, 1e-6);
        ASSERT_TRUE(hull.run());
        std::set<std::uint32_t> corners;
        for (const HullTriangle& t : hull.triangles()) {
            corners.insert(t.corners.begin(), t.corners.end());
        }
        EXPECT_EQ(corners.count(8), beside > 1e-6 ? 1u : 0u);
        EXPECT_EQ(corners.size(), beside > 1e-6 ? 9u : 8u);
        const std::vector<std::uint32_t>& near = hull.near();
        EXPECT_EQ(std::count(near.begin(), near.end(), 8u), beside > 1e-6 ? 0 : 1) << "what may be outside is told";
        EXPECT_EQ(std::count(near.begin(), near.end(), 9u), 0);
        EXPECT_EQ(std::count(near.begin(), near.end(), 10u), 0) << "nothing is outside of a corner";
    }
    const std::vector<Vec3> plate{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.9e-6}};
    EXPECT_FALSE(Quickhull(plate, 2, 1e-6).run());
    EXPECT_TRUE(Quickhull(plate, 2, 1e-7).run());
}

TEST(Quickhull, WhatIsOutsideByJustTheToleranceIsNoCorner) {
    constexpr double tolerance = 0x1p-20;
    const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {0.0, 1.0}) {
            for (const double beside : {tolerance, tolerance + 0x1p-50}) {
                std::vector<Vec3> points = cube;
                points.push_back({0.375, 0.375, 0.375});
                points.back()[axis] = side > 0 ? 1 + beside : -beside;
                points[8][(axis + 1) % 3] = 0.25;
                Quickhull hull(points, 2, tolerance);
                ASSERT_TRUE(hull.run());
                std::set<std::uint32_t> corners;
                for (const HullTriangle& t : hull.triangles()) {
                    corners.insert(t.corners.begin(), t.corners.end());
                }
                EXPECT_EQ(corners.size(), beside > tolerance ? 9u : 8u);
            }
        }
    }
    const std::vector<Vec3> plate{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, tolerance}};
    EXPECT_FALSE(Quickhull(plate, 2, tolerance).run());
    EXPECT_TRUE(Quickhull(plate, 2, std::nextafter(tolerance, 0)).run());
}

} // namespace
