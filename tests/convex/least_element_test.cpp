// foam::least_element(): it holds the points, is the least where that is known, and near the proved bound elsewhere.
#include "convex/random_points.hpp"

#include <foam/base/error.hpp>
#include <foam/base/random.hpp>
#include <foam/search/least_element.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace foam;
using test::random_points;
using ::testing::HasSubstr;
using Kind = Element::Kind;

Pose some_pose(std::uint64_t seed) {
    Random random(seed);
    const Vec3 axis = normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    Pose pose = Pose::from_axis_angle(axis, random.uniform(0, 3));
    pose.translation = {random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2)};
    return pose;
}

void expect_holds(const Element& element, const std::vector<Vec3>& points) {
    EXPECT_TRUE(is_valid(element)) << to_string(element.kind);
    for (const Vec3& p : points) {
        ASSERT_TRUE(holds(element, p)) << to_string(element.kind);
    }
}

constexpr Kind all_kinds[] = {Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull,
                              Kind::ellipsoid};

TEST(LeastElement, HoldsTheirPointsAtAnySizeAndPlace) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        for (const double scale : {1e-6, 1.0, 1e5}) {
            std::vector<Vec3> points = random_points(200, seed);
            for (Vec3& p : points) {
                p = some_pose(seed) * p * scale;
            }
            for (const Kind kind : all_kinds) {
                for (const Effort effort : {Effort::fast, Effort::normal}) {
                    const Element element = least_element(kind, points, effort);
                    EXPECT_EQ(element.kind, kind);
                    expect_holds(element, points);
                }
            }
        }
    }
}

TEST(LeastElement, FindsATurnedBox) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Pose pose = some_pose(seed);
        std::vector<Vec3> corners;
        for (int i = 0; i < 8; ++i) {
            corners.push_back(pose * Vec3{i & 1 ? 1.0 : -1.0, i & 2 ? 0.7 : -0.7, i & 4 ? 0.4 : -0.4});
        }
        const double expected = 8 * 1 * 0.7 * 0.4;
        EXPECT_NEAR(volume(least_element(Kind::box, corners, Effort::fast)), expected, 1e-8 * expected);
        EXPECT_LE(volume(least_element(Kind::swept_box, corners)), expected * (1 + 1e-5)); // it has a radius
    }
}

TEST(LeastElement, FindsATurnedCapsule) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const Pose pose = some_pose(seed);
        std::vector<Vec3> points;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 d = normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
            points.push_back(pose * (d * 0.3 + Vec3{0, 0, d.z > 0 ? 0.5 : -0.5}));
        }
        const double expected = std::numbers::pi * 0.09 * 1 + 4 * std::numbers::pi / 3 * 0.027;
        const double found = volume(least_element(Kind::capsule, points));
        EXPECT_LE(found, expected * (1 + 1e-6));
        EXPECT_GE(found, expected * 0.97); // sampled points leave some room
        EXPECT_LE(volume(least_element(Kind::swept_box, points)), found * (1 + 1e-9));
    }
}

TEST(LeastElement, FindsATurnedEllipsoid) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const Element known = moved(Element::ellipsoid({1, 0.5, 0.2}), some_pose(seed));
        std::vector<Vec3> points;
        for (int i = 0; i < 3000; ++i) {
            const Vec3 d = normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
            points.push_back(support(known, d));
        }
        const double found = volume(least_element(Kind::ellipsoid, points));
        EXPECT_LE(found, volume(known) * (1 + 1e-6));
        EXPECT_GE(found, volume(known) * 0.98); // sampled points leave some room
        EXPECT_LE(volume(least_element(Kind::ellipsoid, points, Effort::fast)), volume(known) * 1.01);
    }
    // The least ellipsoid around a box has half axes √3 times its half edges (John 1948).
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        corners.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 0.5 : -0.5, i & 4 ? 0.25 : -0.25});
    }
    EXPECT_NEAR(volume(least_element(Kind::ellipsoid, corners)),
                4.0 / 3 * std::numbers::pi * std::pow(3, 1.5) * 0.125, 1e-5);
}

TEST(LeastElement, FindsATurnedCylinder) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Pose pose = some_pose(seed);
        std::vector<Vec3> points;
        for (int i = 0; i < 64; ++i) {
            const double angle = 2 * std::numbers::pi * i / 64;
            for (const double z : {-0.8, 0.8}) {
                points.push_back(pose * Vec3{0.3 * std::cos(angle), 0.3 * std::sin(angle), z});
            }
        }
        const double expected = std::numbers::pi * 0.09 * 1.6;
        EXPECT_NEAR(volume(least_element(Kind::cylinder, points)), expected, 1e-6 * expected);
    }
}

TEST(LeastElement, IsWithinTheTolerancesOfItsProof) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const std::vector<Vec3> points = random_points(12, seed);
        for (const Kind kind : {Kind::box, Kind::cylinder, Kind::capsule}) {
            const double tolerance = 0.05;
            const ProvedElement proved = proved_least(kind, points, tolerance);
            expect_holds(proved.element, points);
            EXPECT_GE(proved.lower_bound, proved.volume * (1 - tolerance) * (1 - 1e-6));
            EXPECT_LE(proved.lower_bound, proved.volume);
            const double quick = volume(least_element(kind, points));
            EXPECT_GE(quick, proved.lower_bound) << to_string(kind);
            EXPECT_LE(quick, proved.volume * 1.02) << to_string(kind) << ", seed " << seed;
        }
    }
}

TEST(LeastElement, OfFlatPointsHasAThickness) {
    const std::vector<std::vector<Vec3>> sets = {{{1, 2, 3}},
                                                 {{0, 0, 0}, {1, 1, 1}},
                                                 {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                 {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}}};
    for (const std::vector<Vec3>& points : sets) {
        for (const Kind kind : all_kinds) {
            const Element element = least_element(kind, points);
            expect_holds(element, points);
            EXPECT_GT(volume(element), 0);
        }
    }
}

TEST(LeastElement, RefusesWhatHasNoElement) {
    EXPECT_THROW(least_element(Kind::box, {}), Error);
    const std::vector<Vec3> infinite = {{0, 0, INFINITY}};
    EXPECT_THROW(least_element(Kind::capsule, infinite), Error);
    const std::vector<Vec3> points = random_points(10, 1);
    const auto refusal = [](Kind kind, double tolerance, const std::vector<Vec3>& around) {
        try {
            proved_least(kind, around, tolerance);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    EXPECT_EQ(refusal(Kind::hull, 0.1, points), ErrorCode::usage);
    EXPECT_EQ(refusal(Kind::box, 0.1, {}), ErrorCode::geometry);
    EXPECT_EQ(refusal(Kind::box, 0.1, infinite), ErrorCode::geometry);
    for (const double tolerance : {0.0, -0.1, std::nan("")}) { // at once, not after a million cells
        EXPECT_EQ(refusal(Kind::box, tolerance, points), ErrorCode::usage);
    }
}

TEST(ProvedLeast, OfAPointIsTheThicknessOfElements) {
    const std::vector<Vec3> point{{1, 2, 3}};
    for (const Kind kind : {Kind::box, Kind::cylinder}) {
        const ProvedElement proved = proved_least(kind, point, 0.1);
        EXPECT_GT(proved.lower_bound, 0);
        EXPECT_LE(proved.lower_bound, proved.volume);
        EXPECT_EQ(proved.cells, kind == Kind::box ? 1u : 3u) << to_string(kind);
    }
}

TEST(ProvedLeast, OnePointThatIsNotFiniteIsRefused) {
    for (std::size_t k = 0; k < 4; ++k) {
        std::vector<Vec3> points = random_points(4, 1, {1, 1, 1});
        points[k].y = k % 2 ? std::nan("") : INFINITY;
        try {
            proved_least(Kind::box, points, 0.1);
            FAIL();
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("an element needs one or more points with finite coordinates"));
        }
    }
}

TEST(ProvedLeast, AMillionCellsAreTheMost) {
    try {
        proved_least(Kind::box, random_points(4, 1), 1e-15);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::geometry);
        EXPECT_THAT(error.what(),
                    HasSubstr("the least box is not proved to 1e-15 within 1000000 cells; remedy: a larger"));
    }
}

} // namespace
