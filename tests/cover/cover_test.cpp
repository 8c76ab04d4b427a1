// foam::spherize(): known covers, monotony, what it refuses.
#include "geometry/shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/base/random.hpp>
#include <foam/geometry/vector.hpp>
#include <foam/runtime/contract.hpp>
#include <foam/search/spherize.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>

namespace {

using namespace foam;

Mesh cube() {
    return test::box({0, 0, 0}, {1, 1, 1});
}

/// Equal balls about the middles of a grid of boxes that the cube is cut into.
std::vector<Sphere> balls_of_boxes(int nx, int ny, int nz) {
    const Vec3 size{1.0 / nx, 1.0 / ny, 1.0 / nz};
    std::vector<Sphere> balls;
    for (int i = 0; i < nx * ny * nz; ++i) {
        const Vec3 middle{(i % nx + 0.5) * size.x, (i / nx % ny + 0.5) * size.y, (i / nx / ny + 0.5) * size.z};
        balls.push_back({middle, norm(size) / 2});
    }
    return balls;
}

void expect_as_good(const SphereCover& cover, const std::vector<Sphere>& known) {
    EXPECT_LE(cover.spheres.size(), known.size());
    EXPECT_TRUE(cover.certificate.holds);
    EXPECT_LE(cover.volume, 1.02 * union_volume(known));
}

TEST(Spherize, CubeByOneTwoFourAndEightBalls) {
    const auto solid = Solid::make(cube());
    const std::vector<std::size_t> counts{1, 2, 4, 8};
    const std::vector<SphereCover> covers = spherize_each(*solid, counts);
    ASSERT_EQ(covers.size(), 4u);
    EXPECT_NEAR(covers[0].spheres[0].radius, std::sqrt(3.0) / 2, 2e-4);
    EXPECT_NEAR(distance(covers[0].spheres[0].center, {0.5, 0.5, 0.5}), 0, 1e-6);
    expect_as_good(covers[0], balls_of_boxes(1, 1, 1));
    expect_as_good(covers[1], balls_of_boxes(2, 1, 1));
    expect_as_good(covers[2], balls_of_boxes(2, 2, 1));
    expect_as_good(covers[3], balls_of_boxes(2, 2, 2));
}

TEST(Spherize, TwoCubesByTwoBallsWhereverTheyAre) {
    for (const Vec3& place : {Vec3{2, 0, 0}, Vec3{3, 2, 1}, Vec3{-1, 2, -4}}) {
        Mesh mesh = cube();
        append(mesh, test::box(place, place + Vec3{1, 1, 1}));
        const SphereCover cover = spherize(*Solid::make(mesh), 2, {.effort = Effort::fast});
        ASSERT_EQ(cover.spheres.size(), 2u);
        for (const Sphere& sphere : cover.spheres) {
            EXPECT_NEAR(sphere.radius, std::sqrt(3.0) / 2, 1e-3);
        }
    }
}

/// The triangles of a box are larger than the balls: what these hold is all between corners.
TEST(Spherize, LargeTrianglesAreHandedOverWherePlanesCutThem) {
    const auto solid = Solid::make(test::box({0, 0, 0}, {2, 1, 0.5}));
    const SphereCover two = spherize(*solid, 2, {.effort = Effort::fast});
    const double radius = std::sqrt(1 + 1 + 0.25) / 2;
    // Smallest balls of the halves are a bound from above; they do better by leaning on each other.
    EXPECT_LE(two.volume,
              1.001 * union_volume(std::vector<Sphere>{{{0.5, 0.5, 0.25}, radius}, {{1.5, 0.5, 0.25}, radius}}));
    EXPECT_TRUE(two.certificate.holds);
}

TEST(Spherize, BallByOne) {
    const auto solid = Solid::make(test::ball({1, 2, 3}, 0.5));
    const SphereCover cover = spherize(*solid, 1);
    EXPECT_NEAR(cover.spheres[0].radius, 0.5, 2e-4);
    EXPECT_TRUE(cover.certificate.holds);
    EXPECT_LE(spherize(*solid, 5).volume, cover.volume) << "more balls are of no use, but do no harm";
}

TEST(Spherize, LongBoxByARow) {
    const auto solid = Solid::make(test::box({0, 0, 0}, {6, 1, 1}));
    std::vector<Sphere> row;
    for (int i = 0; i < 6; ++i) {
        row.push_back({{i + 0.5, 0.5, 0.5}, std::sqrt(3.0) / 2});
    }
    expect_as_good(spherize(*solid, 6), row);
}

TEST(Spherize, Capsule) {
    const Element capsule = Element::capsule(0.1, 0.2);
    const auto solid = Solid::make(std::vector<Solid::Part>{{nullptr, capsule, Pose{}}});
    expect_as_good(spherize(*solid, 1), {{{0, 0, 0}, 0.2}});
    // Those at the ends hold their caps and meet the one in the middle on the cylinder.
    expect_as_good(spherize(*solid, 3), {{{0, 0, -0.08}, 0.12}, {{0, 0, 0}, 0.101}, {{0, 0, 0.08}, 0.12}});
}

TEST(Spherize, MoreBallsNeverClaimMore) {
    const std::vector<std::size_t> counts{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 16, 20};
    for (const char* name : {"Bracket", "Torus"}) {
        SCOPED_TRACE(name);
        const auto solid = sample::solids().at(name)();
        double least = std::numeric_limits<double>::infinity();
        std::size_t i = 0;
        for (const SphereCover& cover : spherize_each(*solid, counts, {.effort = Effort::fast})) {
            EXPECT_TRUE(cover.certificate.holds);
            EXPECT_LE(cover.spheres.size(), counts[i++]);
            EXPECT_LE(cover.volume, least);
            least = cover.volume;
        }
    }
}

// Few balls are left where more are of no use; those cannot give way to each other.
TEST(Spherize, BestEffortOnAFlatCylinder) {
    const Element cylinder = Element::cylinder(0.04, 0.0464);
    const auto solid = Solid::make(std::vector<Solid::Part>{{nullptr, cylinder, Pose{}}});
    const std::vector<std::size_t> counts{1, 2, 3, 4, 5, 6};
    double before = std::numeric_limits<double>::infinity();
    for (const SphereCover& cover : spherize_each(*solid, counts, {.effort = Effort::best})) {
        EXPECT_TRUE(cover.certificate.holds);
        EXPECT_LE(cover.volume, before);
        before = cover.volume;
    }
}

TEST(Spherize, TheSameAloneAndBesideOtherCounts) {
    const auto solid = sample::solids().at("Bracket")();
    const std::vector<std::size_t> counts{7, 3};
    const std::vector<SphereCover> covers = spherize_each(*solid, counts, {.effort = Effort::fast});
    for (std::size_t i = 0; i < counts.size(); ++i) {
        EXPECT_EQ(covers[i].spheres, spherize_each(*solid, {&counts[i], 1}, {.effort = Effort::fast})[0].spheres);
    }
}

TEST(Cover, OfSpheresIsThatOfSpherize) {
    const auto solid = sample::solids().at("Bracket")();
    const CoverOptions options{.effort = Effort::fast};
    const Cover found = cover(*solid, 7, options);
    EXPECT_EQ(found.elements.spheres(), spherize(*solid, 7, options).spheres);
    EXPECT_TRUE(found.elements.are_spheres());
}

TEST(Cover, OfPointsHoldsAllOfTheirBalls) {
    Random random(4);
    std::vector<Sphere> balls;
    for (int i = 0; i < 60; ++i) {
        balls.push_back({{random.uniform(-1, 1), random.uniform(-0.3, 0.3), random.uniform(0, 0.1)},
                         i % 3 == 0 ? 0 : random.uniform(0.001, 0.1)});
    }
    balls.push_back(balls.front()); // twice
    for (const Element::Kind kind : every_kind()) {
        SCOPED_TRACE(to_string(kind));
        const Cover found = cover(balls, 3, {.kinds = {kind}, .effort = Effort::fast});
        EXPECT_TRUE(found.certificate.holds);
        EXPECT_LE(found.elements.size(), 3u);
        for (const Sphere& ball : balls) {
            for (const Vec3& direction : fibonacci_directions(50)) {
                const Vec3 p = ball.center + direction * ball.radius;
                EXPECT_TRUE(std::any_of(found.elements.begin(), found.elements.end(),
                                        [&](const Element& e) { return distance(e, p) < 1e-12; }));
            }
        }
    }
}

TEST(Cover, OfNoPointsAndOfNumbersThatAreNone) {
    EXPECT_THROW(cover(std::vector<Sphere>{}, 1), Error);
    EXPECT_THROW(cover(std::vector<Sphere>{{{0, 0, 0}, -1}}, 1), Error);
    EXPECT_THROW(cover(std::vector<Sphere>{{{0, std::nan(""), 0}, 1}}, 1), Error);
    EXPECT_TRUE(cover(std::vector<Sphere>{{{3, 4, 5}, 0}}, 1).certificate.holds) << "one point";
    const Cover one = cover(std::vector<Sphere>{{{3, 4, 5}, 2}, {{3, 4, 5.5}, 1}}, 4);
    ASSERT_EQ(one.elements.size(), 1u) << "one ball holds the other";
    EXPECT_NEAR(one.elements.spheres()[0].radius, 2, 1e-12);
}

TEST(Spherize, ASearchGivesTheSameWhateverWasAskedBefore) {
    const auto solid = sample::solids().at("Bracket")();
    const CoverOptions options{.effort = Effort::fast};
    CoverSearch search(*solid, options);
    for (const std::size_t count : {7, 3, 9, 7}) {
        EXPECT_EQ(search.cover(count).elements.spheres(), spherize_each(*solid, {&count, 1}, options)[0].spheres) << count;
    }
}

TEST(Spherize, ASearchThatWasBrokenOffGoesOn) {
    const auto solid = sample::solids().at("Bracket")();
    int questions = 0;
    const auto stop = [&] {
        if (++questions == 3) {
            throw Error(ErrorCode::cancelled, "enough");
        }
        return false;
    };
    CoverSearch search(*solid, {.effort = Effort::fast, .stop = stop});
    EXPECT_THROW(search.cover(7), Error);
    EXPECT_EQ(search.cover(7).elements.spheres(), CoverSearch(*solid, {.effort = Effort::fast}).cover(7).elements.spheres());
}

TEST(Spherize, StoppedItIsCertifiedAllTheSame) {
    const auto solid = sample::solids().at("Torus")();
    const SphereCover cover = spherize(*solid, 12, {.stop = [] { return true; }});
    EXPECT_TRUE(cover.certificate.holds);
    EXPECT_TRUE(certify(*solid, cover.spheres).holds);
}

TEST(Spherize, StoppedAtAnyTimeItIsAsGoodAsFast) {
    const auto solid = sample::solids().at("Bracket")();
    const double fast = spherize(*solid, 6, {.effort = Effort::fast}).volume;
    for (const int polls : {0, 1, 2, 4, 6, 8}) {
        SCOPED_TRACE(polls);
        int asked = 0;
        const SphereCover cover = spherize(*solid, 6, {.stop = [&] { return asked++ >= polls; }});
        EXPECT_TRUE(certify(*solid, cover.spheres).holds);
        EXPECT_LE(cover.spheres.size(), 6u);
        if (polls > 2) { // those of the effort fast are over
            EXPECT_LE(cover.volume, fast);
        }
    }
}

TEST(Spherize, ASearchThatWasStoppedOnceKeepsNoHalfResult) {
    const auto solid = sample::solids().at("Bracket")();
    constexpr std::size_t count = 64; // it ends with random swaps
    int asked = 0, stopped_at = -1;
    const auto search = [&] {
        asked = 0;
        return std::make_unique<CoverSearch>(*solid, CoverOptions{.stop = [&] { return asked++ == stopped_at; }});
    };
    const std::vector<Sphere> whole = search()->cover(count).elements.spheres();
    constexpr int last_questions = 5;
    const int questions = asked;
    for (stopped_at = questions - last_questions; stopped_at < questions; ++stopped_at) {
        const auto stopped = search();
        stopped->cover(count);
        EXPECT_EQ(stopped->cover(count).elements.spheres(), whole) << "stopped at question " << stopped_at << " of " << questions;
    }
}

TEST(Spherize, NeverStoppedItIsAsIfNobodyAsked) {
    const auto solid = sample::solids().at("Bracket")();
    int asked = 0;
    const SphereCover cover = spherize(*solid, 6, {.stop = [&] { return ++asked < 0; }});
    EXPECT_EQ(cover.spheres, spherize(*solid, 6).spheres);
    EXPECT_GE(asked, 10);
}

TEST(Spherize, OfNoSpheresIsRefused) {
    try {
        spherize(cube(), 0);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_STREQ(error.what(),
                     "spherize: a cover needs at least 1 sphere, got a count of 0; remedy: ask for 1 or more");
    }
}

} // namespace
