// Eroded elements: what they hold, how far points are outside, and the slack of docs/dev/certificate.md.
#include "evaluate/element_truth.hpp"
#include "geometry/src/proof/bodies.hpp"
#include "geometry/src/convex/polytope.hpp"
#include "plain_shapes.hpp"

#include <foam/geometry/internal/triangles.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using Kind = Element::Kind;
using ::testing::ElementsAre;

namespace {

constexpr double unit = 0x1p-53;
constexpr std::uint32_t most_halvings = 120;
/// Makes the slack large, so that it is seen apart from rounding.
constexpr double caution = 1e9;

Element some_element(Kind kind, Random& random) {
    const auto length = [&] { return random.uniform(0.5, 1.5); };
    Element e{.kind = kind, .pose = test::random_pose(random, 2)};
    e.radius = kind == Kind::box || kind == Kind::hull ? 0 : length();
    if (kind == Kind::box || kind == Kind::swept_box) {
        e.half = {length(), length(), length()};
    } else if (kind == Kind::capsule || kind == Kind::cylinder) {
        e.half.z = length();
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        for (int k = 0; k < 20; ++k) {
            points.push_back(Vec3{5, 0, 0} + test::random_direction(random) * length());
        }
        e.hull = convex_hull(points);
    }
    return e;
}

/// The largest distance of a point of the element from its middle; `middle`: in the element's frame.
double reach_of(const Element& e, Vec3& middle) {
    middle = {};
    if (!e.hull) {
        return norm(e.half) + e.radius;
    }
    middle = inner_point(*e.hull);
    double reach = 0;
    for (const Vec3& v : e.hull->surface.vertices) {
        reach = std::max(reach, distance(v, middle));
    }
    return reach;
}

class EachBody : public ::testing::TestWithParam<Kind> {
protected:
    Random random{derive_seed(21, to_string(GetParam()))};
};
INSTANTIATE_TEST_SUITE_P(Kinds, EachBody,
                         ::testing::Values(Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box,
                                           Kind::hull),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(EachBody, TheSlackIsThatOfTheArgument) {
    for (int k = 0; k < 20; ++k) {
        const Element e = some_element(GetParam(), random);
        const Vec3 origin = test::random_direction(random) * random.uniform(0, 50);
        const double extent = random.uniform(0, 20);
        Vec3 m;
        const double s = reach_of(e, m), turned = norm(e.pose.rotate(m));
        const double c = norm(e.pose.rotate(m) + e.pose.translation - origin);
        const double expected = 2 * unit * (most_halvings + 24) * (extent + c + s) +
                                16 * unit * (norm(origin) + norm(e.pose.translation) + turned);
        const Bodies bodies(Elements(std::span(&e, 1)), origin, extent, most_halvings);
        EXPECT_NEAR(bodies.slack(0), expected, 1e-12 * expected);
        EXPECT_NEAR(bodies.rounding(), 16 * expected, 1e-11 * expected);
        EXPECT_LE(distance(bodies.center(0), e.pose.rotate(m) + e.pose.translation - origin), 1e-13);
        const double careful = caution * (expected - 16 * unit * (norm(e.pose.translation) + turned)) +
                               16 * unit * (norm(e.pose.translation) + turned);
        const Bodies cautious(Elements(std::span(&e, 1)), origin, extent, most_halvings, caution);
        EXPECT_NEAR(cautious.slack(0), careful, 1e-12 * careful);
    }
}

TEST_P(EachBody, AnInexactRotationAddsToTheSlack) {
    if (GetParam() == Kind::sphere) {
        return; // it has no rotation
    }
    for (int k = 0; k < 20; ++k) {
        Element e = some_element(GetParam(), random);
        const double before = Bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings).slack(0);
        for (Vec3& row : e.pose.rotation) {
            row += test::random_direction(random) * 1e-8;
        }
        double most = 0;
        const auto& r = e.pose.rotation;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                const Vec3 a{r[0][static_cast<int>(i)], r[1][static_cast<int>(i)], r[2][static_cast<int>(i)]},
                    b{r[0][static_cast<int>(j)], r[1][static_cast<int>(j)], r[2][static_cast<int>(j)]};
                most = std::max({most, std::abs(dot(a, b) - (i == j)), std::abs(dot(r[i], r[j]) - (i == j))});
            }
        }
        Vec3 m;
        const double s = reach_of(e, m);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings);
        EXPECT_NEAR(bodies.slack(0) - before, 2 * 3 * most * s, 1e-6 * most);
    }
}

/// How far the point is outside of the element that is smaller by `slack`, by the definition of erosion.
double depth_in_eroded(const Element& e, double slack, const Vec3& p) {
    const Vec3 v = p - e.pose.translation;
    const auto& r = e.pose.rotation;
    const Vec3 q = r[0] * v.x + r[1] * v.y + r[2] * v.z;
    if (e.hull) {
        return static_cast<double>(test::Judge(e).outside(test::quad(p))) + slack;
    }
    const auto out = [](double at, double half) { return std::max(std::abs(at) - half, 0.0); };
    if (e.kind == Kind::cylinder) {
        const double across = std::hypot(q.x, q.y) - (e.radius - slack), along = std::abs(q.z) - (e.half.z - slack);
        return std::max(across, along) <= 0 ? std::max(across, along)
                                            : std::hypot(std::max(across, 0.0), std::max(along, 0.0));
    }
    const Vec3 half = e.kind == Kind::box ? e.half - Vec3{1, 1, 1} * slack : e.half;
    const double beyond = norm({out(q.x, half.x), out(q.y, half.y), out(q.z, half.z)});
    const double most = std::max({std::abs(q.x) - half.x, std::abs(q.y) - half.y, std::abs(q.z) - half.z});
    return e.kind == Kind::box ? (most <= 0 ? most : beyond) : beyond - (e.radius - slack);
}

TEST_P(EachBody, HoldsWhatIsInsideByMoreThanTheSlack) {
    int inside = 0, between = 0;
    for (int k = 0; k < 40; ++k) {
        const Element e = some_element(GetParam(), random);
        const Vec3 origin{1, 2, 3};
        const Bodies bodies(Elements(std::span(&e, 1)), origin, 5, most_halvings, caution);
        const double slack = bodies.slack(0);
        ASSERT_GT(slack, 1e-5);
        for (int i = 0; i < 100; ++i) {
            const Vec3 way = test::random_direction(random);
            const double inwards = i % 2 ? slack * random.uniform(0, 3) : random.uniform(-0.5, 1);
            const Vec3 p = support(e, way) - way * inwards;
            const double depth = depth_in_eroded(e, slack, p);
            EXPECT_NEAR(bodies.depth(0, p - origin), depth, 1e-12) << inwards;
            if (std::abs(depth) > 1e-12) {
                EXPECT_EQ(bodies.holds(0, p - origin), depth < 0) << inwards;
            }
            inside += depth < 0;
            between += depth > 0 && depth < slack;
            if (!e.hull) {
                EXPECT_EQ(bodies.growth(0, p - origin), std::max(0.0, bodies.depth(0, p - origin)));
            }
        }
    }
    EXPECT_GT(inside, 500);
    EXPECT_GT(between, 50);
}

TEST_P(EachBody, HoldsABallWhereItsRadiusIsLeft) {
    int held = 0;
    for (int k = 0; k < 40; ++k) {
        const Element e = some_element(GetParam(), random);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution);
        for (int i = 0; i < 50; ++i) {
            const double radius = random.uniform(0, i % 2 ? 1 : 0.1);
            Vec3 m;
            reach_of(e, m);
            const Vec3 way = test::random_direction(random);
            const auto place = [&](double share) {
                const Vec3 middle = e.pose * m;
                return middle + (support(e, way) - middle) * share;
            };
            const Vec3 from = place(random.uniform(-0.3, 1)), to = place(random.uniform(-0.3, 1));
            // a ball is held where a smaller element holds its middle
            const double less = bodies.slack(0) + radius;
            double deepest = -1e300;
            for (const Vec3& p : {from, to}) {
                Element thinner = e; // what a radius does not suffice for is taken from the box
                const double rest = std::max(0.0, less - e.radius);
                const bool round = e.kind == Kind::sphere || e.kind == Kind::capsule || e.kind == Kind::swept_box;
                thinner.half = round ? e.half - Vec3{1, 1, 1} * rest : e.half;
                const bool empty = round && rest > 0 && std::min({thinner.half.x, thinner.half.y, thinner.half.z}) < 0;
                deepest = std::max(deepest, empty ? 1 : depth_in_eroded(thinner, less - (round ? rest : 0), p));
            }
            const RoundPart part{0, 0, from, to, from, radius};
            if (std::abs(deepest) > 1e-12) {
                EXPECT_EQ(bodies.holds(0, part), deepest < 0) << radius << ' ' << deepest;
            }
            held += deepest < 0;
        }
    }
    EXPECT_GT(held, 300);
}

TEST_P(EachBody, PlanesAreThoseOfBoxesAndHulls) {
    int inside = 0, outside = 0;
    for (int k = 0; k < 20; ++k) {
        const Element e = some_element(GetParam(), random);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution);
        EXPECT_EQ(bodies.planes(0).size(), e.hull ? e.hull->faces.size() : e.kind == Kind::box ? 6 : 0);
        for (int i = 0; i < 100 && !bodies.planes(0).empty(); ++i) {
            const Vec3 outermost = support(e, test::random_direction(random));
            const Vec3 p = outermost + (bodies.center(0) - outermost) * random.uniform(0, 4e-3) +
                           test::random_direction(random) * bodies.slack(0);
            double most = -1e300;
            for (const Polytope::Face& plane : bodies.planes(0)) {
                most = std::max(most, dot(plane.normal, p - bodies.center(0)) - plane.offset);
            }
            EXPECT_TRUE(std::abs(most) < 1e-12 || bodies.holds(0, p) == (most < 0));
            inside += bodies.holds(0, p);
            outside += !bodies.holds(0, p);
        }
    }
    EXPECT_TRUE((inside > 300 && outside > 100) || inside + outside == 0) << inside << ' ' << outside;
}

TEST_P(EachBody, BoundsAreThoseOfTheElementAndTwoSlacks) {
    for (int k = 0; k < 20; ++k) {
        const Element e = some_element(GetParam(), random);
        const Vec3 origin{1, 2, 3};
        const Bodies bodies(Elements(std::span(&e, 1)), origin, 5, most_halvings, caution);
        const Vec3 room = Vec3{2, 2, 2} * bodies.slack(0);
        const Box box = bounds(e);
        EXPECT_LE(distance(bodies.bounds(0).low, box.low - origin - room), 1e-13);
        EXPECT_LE(distance(bodies.bounds(0).high, box.high - origin + room), 1e-13);
    }
}

TEST(Bodies, TheGrowthOfAHullIsTheDistanceAndTwoSlacks) {
    Random random(1);
    for (int k = 0; k < 40; ++k) {
        const Element e = some_element(Kind::hull, random);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution);
        for (int i = 0; i < 20; ++i) {
            const Vec3 p = support(e, test::random_direction(random)) + test::random_direction(random);
            if (bodies.holds(0, p)) {
                EXPECT_EQ(bodies.growth(0, p), 0);
                continue;
            }
            const Mesh& surface = e.hull->surface;
            double nearest = 1e300;
            for (const auto& [a, b, c] : surface.triangles) {
                const Corners t{e.pose * surface.vertices[a], e.pose * surface.vertices[b],
                                e.pose * surface.vertices[c]};
                nearest = std::min(nearest, distance(closest_on_triangle(t, p), p));
            }
            if (bodies.depth(0, p) > 2 * bodies.slack(0)) {
                EXPECT_NEAR(bodies.growth(0, p), nearest + 2 * bodies.slack(0), 1e-12);
            }
        }
    }
}

std::vector<Element> many(Random& random, double range) {
    std::vector<Element> elements;
    for (int k = 0; k < 60; ++k) {
        elements.push_back(some_element(static_cast<Kind>(k % 6), random));
        elements.back().pose.translation = Vec3{random.uniform(-range, range), random.uniform(-range, range), 0};
    }
    return elements;
}

TEST(Bodies, AreFoundByPlace) {
    Random random(2);
    const std::vector<Element> elements = many(random, 6);
    const Bodies bodies({{}, elements}, {}, 10, most_halvings);
    std::vector<std::uint32_t> result{7, 7};
    for (int k = 0; k < 300; ++k) {
        const Vec3 p = test::random_point(random, {{-8, -8, -2}, {8, 8, 2}});
        Box box{p, p};
        if (k % 2) {
            box.add(p + test::random_direction(random));
        }
        std::vector<std::uint32_t> meet, hold, holders;
        for (std::uint32_t i = 0; i < bodies.size(); ++i) {
            const Box& b = bodies.bounds(i);
            bool meets = true;
            for (int axis = 0; axis < 3; ++axis) {
                meets = meets && b.low[axis] <= box.high[axis] && b.high[axis] >= box.low[axis];
            }
            if (meets) {
                meet.push_back(i);
            }
            if (bodies.holds(i, p)) {
                hold.push_back(i);
            }
        }
        bodies.meeting(box, result);
        EXPECT_EQ(result, meet);
        bodies.holders(p, [&](std::uint32_t i) { holders.push_back(i); });
        std::sort(holders.begin(), holders.end());
        EXPECT_EQ(holders, hold);
    }
}

TEST(Bodies, NearAreThoseThatMayBeNearestToAPoint) {
    Random random(3);
    const std::vector<Element> elements = many(random, 20);
    const Bodies bodies({{}, elements}, {}, 10, most_halvings);
    for (int k = 0; k < 100; ++k) {
        const Vec3 a = test::random_point(random, {{-20, -20, -5}, {20, 20, 5}});
        const Piece piece{.corners = {a, a + test::random_direction(random) * 2, a + test::random_direction(random)},
                          .beneath = {}};
        std::vector<std::uint32_t> near{3, 8, 1, 9, 27, 30, 31, 41, 55}, expected = near;
        const PieceMiddle middle = middle_of(piece);
        double least = 1e300;
        for (std::size_t i = 2; i < 8; ++i) {
            least = std::min(least, bodies.growth(near[i], middle.point));
        }
        for (std::size_t i = 2; i < 8; ++i) {
            if (bodies.growth(near[i], middle.point) <= least + 2.0005 * middle.radius) {
                expected.push_back(near[i]);
            }
        }
        bodies.choose_near(piece, 2, 8, near);
        EXPECT_EQ(near, expected) << k;
    }
}

TEST(Bodies, NearAreThoseThatMayContainAPointInSpiteOfTheirSlack) {
    // A body that needs the least and one that needs more: by twice the piece's radius, and by some slacks.
    const Piece piece{.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .beneath = {}};
    const PieceMiddle middle = middle_of(piece);
    for (const double slacks : {3.5, 3.9, 4.1, 4.5}) {
        std::vector<Element> balls(2, {.kind = Kind::sphere, .radius = 1});
        balls[0].pose.translation = middle.point + Vec3{0, 0, 2};
        double more = 0;
        for (int k = 0; k < 3; ++k) { // the slack depends a little on the place
            balls[1].pose.translation = middle.point - Vec3{0, 0, 2 + more};
            const Bodies bodies({{}, balls}, {}, 5, most_halvings, caution);
            ASSERT_GT(bodies.slack(1), 1e-5);
            more = 2.001 * middle.radius + slacks * bodies.slack(1) - (bodies.slack(1) - bodies.slack(0));
        }
        const Bodies bodies({{}, balls}, {}, 5, most_halvings, caution);
        std::vector<std::uint32_t> near{0, 1};
        bodies.choose_near(piece, 0, 2, near);
        EXPECT_EQ(near.size(), slacks < 4 ? 4u : 3u) << slacks;
    }
}

TEST(Bodies, TheGapIsThatOfTheCornerThatIsFarthestFromAllBodies) {
    std::vector<Element> balls(2, {.kind = Kind::sphere, .radius = 1});
    balls[0].pose.translation = {-2, 0, 0};
    balls[1].pose.translation = {4, 0, 0};
    const Bodies bodies({{}, balls}, {}, 5, most_halvings);
    const std::array<std::uint32_t, 2> both{0, 1};
    // Corners are 1, 0.5 and 3 from the first, and 3, 3.5 and 1 from the second.
    const Piece piece{.corners = {{0, 0, 0}, {-0.5, 0, 0}, {2, 0, 0}}, .beneath = {}};
    const Bodies::Gap gap = bodies.gap(piece, both);
    EXPECT_FALSE(gap.held);
    EXPECT_NEAR(gap.lower, 1, 1e-12);
    EXPECT_NEAR(gap.upper, 3, 1e-12);
    EXPECT_NE(gap.farthest, 1u);
    EXPECT_NEAR(bodies.gap(piece, std::span(both).first(1)).lower, 3, 1e-12);
    EXPECT_EQ(bodies.gap(piece, std::span(both).first(1)).farthest, 2u);
    EXPECT_NEAR(bodies.gap(piece, std::span(both).last(1)).upper, 3.5, 1e-12);
    EXPECT_EQ(bodies.gap(piece, std::span(both).last(1)).farthest, 1u);
    const Piece inside{.corners = {{4, 0, 0}, {4.5, 0, 0}, {4, 0.5, 0}}, .beneath = {}};
    EXPECT_TRUE(bodies.gap(inside, both).held);
    EXPECT_FALSE(bodies.gap(inside, std::span(both).first(1)).held);
    // Between the two, nearer to either: 0.25 from the first at most.
    const Piece near{.corners = {{-0.75, 0, 0}, {-0.9, 0, 0}, {-1.5, 0, 0}}, .beneath = {}};
    EXPECT_NEAR(bodies.gap(near, both).upper, 0.25, 1e-12);
    EXPECT_NEAR(bodies.gap(near, both).lower, 0.25, 1e-12);
    EXPECT_EQ(bodies.gap(near, both).farthest, 0u);
    const Piece prism{.corners = inside.corners, .beneath = {{4, 0, 0}, {4.5, 0, 2}, {4, 0.5, 0}}, .curved = true};
    EXPECT_FALSE(bodies.gap(prism, both).held);
    EXPECT_EQ(bodies.gap(prism, std::span(both).last(1)).farthest, 4u);
    EXPECT_TRUE(bodies.holds(1, inside));
    EXPECT_FALSE(bodies.holds(0, inside));
    EXPECT_FALSE(bodies.holds(1, prism));
}

TEST(Bodies, WhatIsThinnerThanTheSlackHoldsNothing) {
    for (const Kind kind : {Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box, Kind::hull}) {
        for (const double share : {0.3, 0.98, 1.02, 3.0}) { // of the slack
            Element e{.kind = kind};
            const double slack = 2 * unit * (most_halvings + 24) * 100 * caution, thin = share * slack;
            e.radius = kind == Kind::box || kind == Kind::hull ? 0 : thin;
            e.half = kind == Kind::box ? Vec3{thin, 2, 2} : kind == Kind::cylinder ? Vec3{0, 0, 2} : Vec3{};
            if (kind == Kind::hull) {
                e.hull = convex_hull(test::box({-thin, -2, -2}, {thin, 2, 2}).vertices);
            } else if (kind == Kind::swept_box) {
                e.half = {0, 2, 2};
            } else if (kind == Kind::capsule) {
                e.half.z = 2;
            }
            const double reach = kind == Kind::sphere                              ? 0
                                 : kind == Kind::capsule || kind == Kind::cylinder ? 2
                                                                                   : std::sqrt(8);
            const Bodies bodies(Elements(std::span(&e, 1)), {}, 100 - reach, most_halvings, caution);
            EXPECT_EQ(bodies.holds(0, Vec3{}), share > 1) << to_string(kind) << ' ' << share;
            std::vector<std::uint32_t> found;
            bodies.meeting({{-9, -9, -9}, {9, 9, 9}}, found);
            EXPECT_EQ(found.size(), share > 1 ? 1u : 0u) << to_string(kind) << ' ' << share;
            EXPECT_EQ(bodies.depth(0, {}) < 0, share > 1) << to_string(kind) << ' ' << share;
            EXPECT_EQ(std::isinf(bodies.growth(0, {50, 0, 0})), share < 1) << to_string(kind) << ' ' << share;
        }
    }
}

/// An element of a kind that is `thin` across, and 2 m or more in other directions, if it has them.
Element thin_element(Kind kind, double thin) {
    Element e{.kind = kind};
    e.radius = kind == Kind::box || kind == Kind::hull ? 0 : thin;
    if (kind == Kind::hull) {
        e.hull = convex_hull(test::box({-thin, -2, -2}, {thin, 2, 2}).vertices);
    } else if (kind != Kind::sphere) {
        e.half = {kind == Kind::box ? thin : 0, kind == Kind::box || kind == Kind::swept_box ? 2.0 : 0, 2};
    }
    return e;
}

TEST_P(EachBody, OfWhatIsAsThinAsTheSlackNothingIsLeft) {
    const auto body_of = [](const Element& e) { return Bodies(Elements(std::span(&e, 1)), {}, 30, most_halvings); };
    double about = 1e-12;
    for (int k = 0; k < 3; ++k) {
        about = body_of(thin_element(GetParam(), about)).slack(0);
    }
    const int steps = 400; // of a last digit, among which what is left is 0 exactly
    int none = 0, some = 0;
    double thin = about * (1 - steps / 4 * 0x1p-52);
    for (int k = 0; k < steps; ++k) {
        thin = std::nextafter(thin, 1);
        const Element e = thin_element(GetParam(), thin);
        const Bodies bodies = body_of(e);
        double left = thin - bodies.slack(0);
        for (const Polytope::Face& plane : e.hull ? bodies.planes(0) : std::span<const Polytope::Face>{}) {
            left = std::min(left, plane.offset);
        }
        none += left == 0;
        some += left > 0;
        EXPECT_EQ(bodies.holds(0, bodies.center(0)), left > 0) << left;
        EXPECT_EQ(std::isinf(bodies.depth(0, {})), !(left > 0)) << left;
    }
    EXPECT_GT(none, 0);
    EXPECT_GT(some, 0);
}

TEST(Bodies, WhatARadiusDoesNotSufficeForIsTakenFromTheBox) {
    Element e{.kind = Kind::swept_box, .half = {1, 2, 3}, .radius = 1e-9};
    const double slack = Bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution).slack(0);
    ASSERT_GT(slack, 1e-5);
    for (const double share : {0.1, 0.5, 0.9, 1.1}) {
        e.radius = share * slack;
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 5, most_halvings, caution);
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 p{};
            const double end = e.half[axis] + e.radius - bodies.slack(0);
            for (const double off : {-1e-9, 1e-9}) {
                p[axis] = end + off;
                EXPECT_EQ(bodies.holds(0, p), off < 0) << axis << ' ' << share;
                EXPECT_NEAR(bodies.depth(0, p), off, 1e-12);
            }
        }
        EXPECT_EQ(bodies.planes(0).size(), share < 1 ? 6u : 0u);
    }
}

TEST(Bodies, NothingIsLeftOfABoxThatIsThinAlongAnyAxis) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const double share : {0.5, 0.99, 1.01}) { // of the slack
            Element e{.kind = Kind::box, .half = {2, 2, 2}};
            const double slack = 2 * unit * (most_halvings + 24) * (30 + std::sqrt(8));
            e.half[axis] = share * slack;
            const Bodies bodies(Elements(std::span(&e, 1)), {}, 30, most_halvings);
            EXPECT_NEAR(bodies.slack(0), slack, 1e-6 * slack);
            EXPECT_EQ(bodies.holds(0, Vec3{}), share > 1) << axis << ' ' << share;
            EXPECT_EQ(std::isinf(bodies.depth(0, Vec3{})), share < 1) << axis << ' ' << share;
        }
    }
}

TEST(Bodies, NothingIsLeftOfACylinderThatIsAsShortAsTheSlack) {
    int none = 0;
    for (int k = -200; k < 200; ++k) {
        Element e{.kind = Kind::cylinder, .half = {0, 0, 1e-30}, .radius = 2};
        const double slack = Bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings).slack(0);
        e.half.z = slack * (1 + k * 0x1p-52);
        const Bodies bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings);
        none += e.half.z == bodies.slack(0);
        EXPECT_EQ(bodies.holds(0, Vec3{}), e.half.z > bodies.slack(0)) << k;
    }
    EXPECT_GT(none, 0);
}

TEST_P(EachBody, WhatIsTooLargeOrTooFarHoldsNothing) {
    Element e = some_element(GetParam(), random);
    e.pose = {};
    const auto is_left = [&](const Element& of, const Vec3& origin) {
        return !std::isinf(Bodies(Elements(std::span(&of, 1)), origin, 1, most_halvings).depth(0, {}));
    };
    EXPECT_TRUE(is_left(e, {}));
    EXPECT_FALSE(is_left(e, {1e200, 0, 0})); // the square of the distance overflows
    e.pose.translation = {1.7e308, 0, 0};
    EXPECT_FALSE(is_left(e, {-1.7e308, 0, 0})); // the difference does
    e = some_element(GetParam(), random);
    e.pose = {};
    e.pose.rotation[2].z = -1; // a reflection
    EXPECT_EQ(is_left(e, {}), GetParam() == Kind::sphere);
    if (e.hull) {
        return;
    }
    e = thin_element(GetParam(), 1e-290); // its length squared overflows, its volume does not
    e.half = e.half * 1e159;
    EXPECT_FALSE(is_left(e, {}));
}

TEST(Bodies, WhatIsNotValidHoldsNothing) {
    Element box{.kind = Kind::box, .half = {1, 1, 1}}, ball{.kind = Kind::sphere, .radius = 1};
    const auto is_held = [](const Element& e) {
        return Bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings).holds(0, Vec3{});
    };
    EXPECT_TRUE(is_held(box));
    EXPECT_TRUE(is_held(ball));
    box.radius = 0.1; // of another kind
    ball.radius = -1;
    EXPECT_FALSE(is_held(box));
    EXPECT_FALSE(is_held(ball));
    EXPECT_FALSE(is_held({.kind = Kind::hull, .radius = 1})); // without a hull
    const std::vector<Sphere> spheres{{{}, std::numeric_limits<double>::infinity()}, {{}, -1}, {{}, 1}};
    const Bodies bodies({spheres, {}}, {}, 1, most_halvings);
    std::vector<std::uint32_t> found;
    bodies.meeting({{-1, -1, -1}, {1, 1, 1}}, found);
    EXPECT_THAT(found, ElementsAre(2));
}

TEST(Bodies, ARotationCountsAsExactUpToSixteenUnits) {
    // Three times the error of its square is 6 units for each unit of an entry.
    const Element before{.kind = Kind::capsule, .radius = 1}; // a point, widened
    const double exact = Bodies(Elements(std::span(&before, 1)), {}, 1, most_halvings).slack(0);
    for (int units = 0; units < 7; ++units) {
        for (int axis = 0; axis < 3; ++axis) {
            Element e = before;
            e.pose.rotation[static_cast<std::size_t>(axis)][axis] = 1 + units * 2 * unit;
            const double added = Bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings).slack(0) - exact;
            EXPECT_NEAR(added, units * 6 > 16 ? 2 * units * 6 * 2 * unit : 0, 0.01 * unit) << units;
        }
    }
}

/// Expects that each triangle of the hull of points lies on or above a plane of the body before its erosion. No plane is
/// farther inside than by `lower`, what rounding asks for.
void expect_planes_below_triangles(const std::vector<Vec3>& points, std::size_t faces, double lower) {
    Element e{.kind = Kind::hull, .hull = convex_hull(points)};
    const auto hull = convex_hull(e.hull->surface.vertices);
    const Bodies bodies(Elements(std::span(&e, 1)), {}, 1, most_halvings);
    const double rounding = 0x1p-51;
    const Vec3 middle = bodies.center(0);
    ASSERT_EQ(bodies.planes(0).size(), hull->faces.size());
    ASSERT_GE(hull->faces.size(), faces);
    for (const auto& t : hull->surface.triangles) {
        double highest = -1; // above a plane, of the corner that is lowest there
        for (const Polytope::Face& plane : bodies.planes(0)) {
            double lowest = 1;
            for (const std::uint32_t v : t) {
                const double height = dot(plane.normal, hull->surface.vertices[v] - middle);
                lowest = std::min(lowest, height - (plane.offset + bodies.slack(0)));
            }
            highest = std::max(highest, lowest);
        }
        EXPECT_GE(highest, -rounding);
    }
    for (std::size_t f = 0; f < hull->faces.size(); ++f) {
        const double given = hull->faces[f].offset - dot(hull->faces[f].normal, middle);
        EXPECT_LE(bodies.planes(0)[f].offset + bodies.slack(0), given + rounding);
        EXPECT_GE(bodies.planes(0)[f].offset + bodies.slack(0), given - lower);
    }
}

TEST(Bodies, PlanesOfAHullGoThroughTheLowestCornersOfTheirTriangles) {
    Random random(5);
    for (int round = 0; round < 20; ++round) {
        // The ends of the prism are plane only up to rounding. Points just beyond the edges of the box make triangles
        // that are too thin for a plane of their own.
        std::vector<Vec3> prism, box = test::box({-1, -0.7, -0.6}, {1, 0.7, 0.6}).vertices;
        for (int k = 0; k < 12; ++k) {
            const double angle = k * std::numbers::pi / 6 + 0.1;
            for (const double z : {-0.5, 0.5}) {
                prism.push_back({std::cos(angle), std::sin(angle), z + random.uniform(-1e-15, 1e-15)});
            }
        }
        expect_planes_below_triangles(prism, 14, 5e-14);
        for (int k = 0; k < 10; ++k) {
            Vec3 p{random.uniform(-1, 1), random.uniform(-0.7, 0.7), random.uniform(-0.6, 0.6)};
            const int along = k % 3;
            for (int axis = 0; axis < 3; ++axis) {
                const double end = axis == 0 ? 1 : axis == 1 ? 0.7 : 0.6;
                p[axis] = axis == along ? p[axis] : std::copysign(end + random.uniform(0, 1e-14), p[axis]);
            }
            box.push_back(p);
        }
        expect_planes_below_triangles(box, 6, 5e-14);
        for (Vec3& p : box) { // far from the origin of its frame, where planes are higher above their triangles
            p += Vec3{100, 30, 20};
        }
        expect_planes_below_triangles(box, 6, 1e-12);
        std::vector<Vec3> corners; // of a box, several within 1e-14 each
        for (int k = 0; k < 60; ++k) {
            const Vec3 corner{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
            corners.push_back(corner + test::random_direction(random) * 1e-14);
        }
        expect_planes_below_triangles(corners, 6, 1e-12);
    }
}

TEST(Bodies, RoundingIsThatOfTheBodyWithTheMostSlack) {
    std::vector<Element> boxes(2, {.kind = Kind::box, .half = {1, 1, 1}});
    boxes[0].pose.translation = {100, 0, 0};
    for (int k = 0; k < 2; ++k) {
        const Bodies bodies({{}, boxes}, {}, 5, most_halvings);
        EXPECT_EQ(bodies.rounding(), 16 * std::max(bodies.slack(0), bodies.slack(1)));
        EXPECT_NE(bodies.slack(0), bodies.slack(1));
        std::swap(boxes[0], boxes[1]);
    }
}

TEST(Bodies, SpheresComeFirst) {
    const std::vector<Sphere> spheres{{{1, 2, 3}, 2}};
    const Element box{.kind = Kind::box, .half = {1, 1, 1}};
    const Bodies bodies(Elements{spheres, {box}}, {1, 0, 0}, 5, most_halvings);
    EXPECT_EQ(bodies.size(), 2u);
    EXPECT_EQ(bodies.center(0), (Vec3{0, 2, 3}));
    EXPECT_EQ(bodies.center(1), (Vec3{-1, 0, 0}));
    EXPECT_NEAR(bodies.depth(0, {0, 2, 6}), 1, 1e-12);
    EXPECT_NEAR(bodies.depth(1, {-1, 0, 4}), 3, 1e-12);
}

} // namespace
