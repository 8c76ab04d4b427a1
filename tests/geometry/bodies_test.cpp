// Eroded elements: what they hold, and the slack of docs/dev/certificate.md.
#include "evaluate/element_truth.hpp"
#include "geometry/each_body.hpp"
#include "geometry/src/convex/polytope.hpp"
#include "geometry/src/proof/bodies.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;
using Kind = Element::Kind;

namespace {

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

INSTANTIATE_TEST_SUITE_P(Kinds, EachBody, eroded_kinds, name_of_kind);

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
