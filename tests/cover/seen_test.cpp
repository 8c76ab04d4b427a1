// Spheres around points that a sensor saw: each point with its error lies in one of them, in milliseconds.
#include <foam/base/error.hpp>
#include <foam/base/internal/activity.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/solid_of_balls.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/cover.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace foam {
namespace {

/// Points on a torus in a frame far from the origin, of a part as large as a hand; each with the error.
std::vector<Sphere> torus(std::size_t count, double error, std::uint64_t seed = 1) {
    Random random(seed);
    std::vector<Sphere> seen;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = random.uniform(0, 2 * std::numbers::pi), b = random.uniform(0, 2 * std::numbers::pi);
        const double across = 0.08 + 0.02 * std::cos(b);
        seen.push_back({{100 + across * std::cos(a), -7 + across * std::sin(a), 0.02 * std::sin(b)}, error});
    }
    return seen;
}

/// Expects each ball in one sphere, in extended precision.
void expect_held(std::span<const Sphere> seen, const Cover& cover) {
    ASSERT_TRUE(cover.elements.are_spheres());
    for (const Sphere& ball : seen) {
        long double out = std::numeric_limits<long double>::infinity();
        for (const Sphere& sphere : cover.elements.spheres()) {
            const long double x = static_cast<long double>(ball.center.x) - sphere.center.x;
            const long double y = static_cast<long double>(ball.center.y) - sphere.center.y;
            const long double z = static_cast<long double>(ball.center.z) - sphere.center.z;
            out = std::min(out, std::sqrt(x * x + y * y + z * z) + ball.radius - sphere.radius);
        }
        ASSERT_LE(out, 0);
    }
}

TEST(Seen, EveryPointLiesInOneSphere) {
    for (const double error : {0.0, 0.0005}) {
        const std::vector<Sphere> seen = torus(5000, error);
        for (const std::size_t count : {1, 2, 7, 16, 64}) {
            const Cover cover = foam::cover(seen, count, {.effort = Effort::fast});
            EXPECT_TRUE(cover.certificate.holds);
            EXPECT_LE(cover.elements.size(), count);
            EXPECT_EQ(cover.volume, exact_union_volume(cover.elements.spheres()));
            expect_held(seen, cover);
        }
    }
}

TEST(Seen, IsAsGoodAsTheSearchForSolids) {
    const std::vector<Sphere> seen = torus(3000, 0);
    const Cover quick = foam::cover(seen, 8, {.effort = Effort::normal});
    const Cover slow = foam::cover(*solid_of_balls(seen), 8, {.effort = Effort::fast});
    EXPECT_LT(quick.volume, 1.02 * slow.volume);
}

TEST(Seen, MoreEffortIsNeverWorse) {
    const std::vector<Sphere> seen = torus(1500, 0.0002);
    double before = std::numeric_limits<double>::infinity();
    for (const Effort effort : {Effort::fast, Effort::normal, Effort::best}) {
        const Cover cover = foam::cover(seen, 6, {.effort = effort});
        EXPECT_LE(cover.volume, before);
        expect_held(seen, cover);
        before = cover.volume;
    }
}

TEST(Seen, IsTheSameOnAnyNumberOfThreads) {
    const std::vector<Sphere> seen = torus(4000, 0.0001);
    Cover one, all;
    on_threads(1, [&] { one = foam::cover(seen, 12, {.effort = Effort::normal}); });
    on_threads(0, [&] { all = foam::cover(seen, 12, {.effort = Effort::normal}); });
    EXPECT_EQ(one.elements.spheres(), all.elements.spheres());
}

TEST(Seen, OddPointsHaveACoverOrAnError) {
    std::vector<Sphere> equal(1000, {{1, 2, 3}, 0}), line, plane, tiny;
    for (int i = 0; i < 1000; ++i) {
        line.push_back({{0.001 * i, 0, 0}, 0});
        plane.push_back({{0.01 * (i % 32), 0.01 * (i / 32), 5}, 0});
        tiny.push_back({{1e-9 * (i % 10), 1e-9 * (i / 10 % 10), 1e-9 * (i / 100)}, 0});
    }
    for (const auto& seen : {equal, line, plane, tiny}) {
        const Cover cover = foam::cover(seen, 4, {.effort = Effort::fast});
        EXPECT_TRUE(cover.certificate.holds);
        expect_held(seen, cover);
    }
    std::vector<Sphere> wrong = plane;
    wrong[7].center.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(foam::cover(wrong, 4), Error);
    wrong = plane;
    wrong[7].radius = -1;
    EXPECT_THROW(foam::cover(wrong, 4), Error);
    wrong = plane;
    wrong[7].center.x = 1e300;
    EXPECT_THROW(foam::cover(wrong, 4), Error);
}

TEST(Seen, AStoppedSearchHasACover) {
    const std::vector<Sphere> seen = torus(5000, 0);
    const Cover cover = foam::cover(seen, 8, {.effort = Effort::best, .stop = [] { return true; }});
    EXPECT_TRUE(cover.certificate.holds);
    expect_held(seen, cover);
}

} // namespace
} // namespace foam
