// Growth of elements until they cover: which of them grow, and by how much.
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using test::box_between;
using Kind = Element::Kind;

namespace {

constexpr double hair = 1e-10;

std::vector<Element> grown_over(const Mesh& mesh, const std::vector<Element>& elements) {
    const auto solid = Solid::make(mesh);
    const Elements level = grown_to_cover(*solid, Elements(elements));
    EXPECT_TRUE(covers(*solid, level));
    return {level.begin(), level.end()};
}

double added(const std::vector<Element>& before, const std::vector<Element>& after, std::size_t i) {
    return volume(after[i]) - volume(before[i]);
}

TEST(ElementGrowth, AFartherElementGrowsIfItAddsLess) {
    // A cube between a wide box and a narrow one that is a little farther away.
    const Mesh cube = test::box({-0.1, -0.1, 0.1}, {0.1, 0.1, 0.3});
    const Element wide = box_between({-1, -1, -0.2}, {1, 1, 0}),
                  narrow = box_between({-0.1, -0.1, 0.42}, {0.1, 0.1, 0.6});
    for (const bool swapped : {false, true}) {
        const std::vector<Element> before = swapped ? std::vector{narrow, wide} : std::vector{wide, narrow};
        const std::vector<Element> after = grown_over(cube, before);
        EXPECT_NEAR(added(before, after, swapped ? 1 : 0), 0, hair);
        EXPECT_NEAR(added(before, after, swapped ? 0 : 1), 0.04 * 0.32, hair);
    }
}

TEST(ElementGrowth, OfFourElementsTheFarthestGrowsIfItAddsLeast) {
    const Mesh cube = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    std::vector<Element> before{box_between({-1, -1, -0.5}, {1, 1, -0.2}), box_between({-1, -1, 0.21}, {1, 1, 0.5}),
                                box_between({-0.5, -1, -1}, {-0.22, 1, 1}),
                                box_between({0.23, -0.1, -0.1}, {0.4, 0.1, 0.1})};
    for (std::size_t place = 0; place < 4; ++place) {
        std::swap(before[place], before[3]);
        const std::vector<Element> after = grown_over(cube, before);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_NEAR(added(before, after, i), i == place ? 0.04 * 0.33 : 0, hair) << place;
        }
        std::swap(before[place], before[3]);
    }
}

TEST(ElementGrowth, TheNearestIsAmongThoseThatAreCompared) {
    const Mesh cube = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    const std::vector<Element> before{
        box_between({-1, -1, -0.5}, {1, 1, -0.2}), box_between({-1, -1, 0.21}, {1, 1, 0.5}),
        box_between({-0.5, -1, -1}, {-0.22, 1, 1}), box_between({-1, -0.5, -1}, {1, -0.23, 1}),
        box_between({0.19, -0.1, -0.1}, {0.4, 0.1, 0.1})};
    const std::vector<Element> after = grown_over(cube, before);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_NEAR(added(before, after, i), i == 4 ? 0.04 * 0.29 : 0, hair);
    }
}

TEST(ElementGrowth, ALongSlitIsClosedByWhatIsBesideIt) {
    const Mesh bar = test::box({-1, -1, -0.1}, {1, 1, 0.1});
    for (const double slit : {1e-2, 1e-4, 1e-6}) {
        const std::vector<Element> before{box_between({-1.1, -1.1, -0.2}, {0, 1.1, 0.2}),
                                          box_between({slit, -1.1, -0.2}, {1.1, 1.1, 0.2})};
        const std::vector<Element> after = grown_over(bar, before);
        EXPECT_GE(after[0].half.x + after[1].half.x, 1.1);
        EXPECT_LE(after[0].half.x + after[1].half.x, 1.1 + slit / 2 + 1e-8); // both by all of it at most
        for (const Element& e : after) {
            EXPECT_NEAR(e.half.y, 1.1, hair);
            EXPECT_NEAR(e.half.z, 0.2, hair);
        }
    }
}

/// An element of which 0.2 at least are around the origin.
Element small_one(Kind kind) {
    Element e{.kind = kind, .radius = kind == Kind::box || kind == Kind::hull ? 0.0 : 0.3};
    if (kind == Kind::box || kind == Kind::swept_box) {
        e.half = Vec3{1, 1, 1} * (kind == Kind::box ? 0.2 : 0.1);
    } else if (kind == Kind::hull) {
        e.hull = convex_hull(test::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}).vertices);
    } else if (kind != Kind::sphere) {
        e.half.z = 0.2;
    }
    return e;
}

TEST(ElementGrowth, ABarBetweenTwoIsShared) {
    const Mesh bar = test::box({-0.05, -0.05, -1}, {0.05, 0.05, 1});
    for (const Kind kind : {Kind::box, Kind::cylinder, Kind::capsule, Kind::swept_box, Kind::hull}) {
        std::vector<Element> ends{small_one(kind), small_one(kind)};
        ends[0].pose.translation = {0, 0, -1};
        ends[1].pose.translation = {0, 0, 1};
        const std::vector<Element> after = grown_over(bar, ends);
        // They meet in the middle; the caps of round ones meet at the bar's edges.
        const double cap = kind == Kind::capsule ? 0.3 - std::sqrt(0.09 - 2 * 0.05 * 0.05) : 0;
        EXPECT_NEAR(bounds(after[0]).high.z, cap, 1e-9) << to_string(kind);
        EXPECT_NEAR(bounds(after[1]).low.z, -cap, 1e-9) << to_string(kind);
        EXPECT_NEAR(bounds(after[0]).size().x, bounds(ends[0]).size().x, 1e-9);
    }
}

TEST(ElementGrowth, OnlyTheElementNearestToARoundPartGrowsAroundIt) {
    for (const double by : {1.0, 0x1p-12, 0x1p12}) {
        const auto solid = test::primitive_solid(Element::sphere(by));
        for (const double less : {1e-3, 4e-3}) {
            Element near{.kind = Kind::sphere, .radius = (1 - less) * by}, far{.kind = Kind::sphere, .radius = by};
            far.pose.translation = {0, 0, 1.2 * less * by};
            for (const auto& elements : {std::vector{near, far}, std::vector{far, near}}) {
                for (const Element& e : grown_to_cover(*solid, Elements(elements))) {
                    EXPECT_NEAR(e.radius / by, 1, hair);
                }
            }
        }
    }
}

TEST(ElementGrowth, ARoundPartThatNoElementIsNearToIsCoveredToo) {
    const auto solid = test::primitive_solid(Element::sphere(1));
    for (const Kind kind : {Kind::box, Kind::sphere, Kind::capsule}) {
        const Element small =
            kind == Kind::box ? Element{.kind = kind, .half = {0.2, 0.2, 0.2}}
                              : Element{.kind = kind, .half = {0, 0, kind == Kind::capsule ? 0.1 : 0}, .radius = 0.5};
        const Element after = grown_to_cover(*solid, Elements(std::vector<Element>{small}))[0];
        EXPECT_TRUE(covers(*solid, Elements(std::span(&after, 1))));
        EXPECT_LE(norm(bounds(after).size() / 2 - Vec3{1, 1, 1}), 0.2) << to_string(kind);
    }
}

TEST(ElementGrowth, TheWorseEndOfACapsuleCounts) {
    const auto solid = test::primitive_solid(Element::capsule(1, 2));
    const Element one_end = box_between({-1, -1, -2}, {1, 1, 2 - 4e-3}),
                  other_end = box_between({-1, -1, 4e-3 - 2}, {1, 1, 2}),
                  both_ends = box_between({-1, -1, 3e-3 - 2}, {1, 1, 2 - 3e-3});
    for (const Element& one : {one_end, other_end}) {
        for (const auto& elements : {std::vector{one, both_ends}, std::vector{both_ends, one}}) {
            std::vector<Element> small = elements;
            for (Element& e : small) { // so that both of them do not cover
                e.half.x -= 2e-3;
            }
            const Elements after = grown_to_cover(*solid, Elements(small));
            for (std::size_t i = 0; i < 2; ++i) {
                const bool grows = elements[i] == both_ends;
                EXPECT_NEAR(after[i].half.z, grows ? 2 : small[i].half.z, hair);
                EXPECT_NEAR(after[i].half.x, grows ? 1 : small[i].half.x, hair);
            }
        }
    }
}

TEST(ElementGrowth, TheCurvedSideOfACylinderIsGivenToTheElementAroundIt) {
    const auto solid = test::primitive_solid(Element::cylinder(1, 2));
    Element low{.kind = Kind::cylinder, .half = {0, 0, 0.6}, .radius = 1.1}, high = low;
    low.pose.translation.z = -0.5;
    high.pose.translation.z = 0.5;
    high.radius = 0.5;
    for (const auto& elements : {std::vector{low, high}, std::vector{high, low}}) {
        for (const Element& e : grown_to_cover(*solid, Elements(elements))) {
            EXPECT_NEAR(e.radius, e.pose.translation.z < 0 ? 1.1 : 1 / std::cos(std::numbers::pi / 64), 0.002);
            EXPECT_NEAR(e.half.z, 0.6, hair);
        }
    }
}

/// A plate around the origin, the vertices of which are so far from that of their own frame that they hardly differ.
Element plate_from_afar(double away, double by) {
    const Vec3 far = Vec3{away, -away, away} * by, half = Vec3{1, 1, 8e-16 * away} * by;
    Element plate{.kind = Kind::hull};
    plate.hull = convex_hull(test::box(far - half, far + half).vertices);
    plate.pose.translation = -far;
    return plate;
}

TEST(ElementGrowth, WhatIsThinnerThanRoundingIsThickenedBeforeItGrows) {
    for (const auto& [away, share] : {std::pair{1e4, 1e-9}, {1e6, 1e-7}, {1e8, 1e-5}}) {
        for (const double half : {1e-9, 1e-5, 1e-2, 1.0}) {
            for (const double by : {1.0, 0x1p-10, 0x1p10}) {
                const auto solid = Solid::make(test::box(Vec3{-1, -1, -half} * by, Vec3{1, 1, half} * by));
                const Element before = plate_from_afar(away, by);
                ASSERT_TRUE(is_valid(before));
                const Element after = grown_to_cover(*solid, Elements(std::vector<Element>{before}))[0];
                EXPECT_TRUE(covers(*solid, Elements(std::span(&after, 1))));
                const double thicker = 1.1 * share * solid->bounds().diagonal() / by;
                const Vec3 size = bounds(after).size() / by;
                EXPECT_LE(size.z / 2, std::max(half, thicker) + 1e-2 * half + thicker) << away;
                EXPECT_LE(size.x / 2, 2.001 + 5 * thicker) << away; // a box along the diagonal, its sides a little askew
            }
        }
    }
}

Vec3 scaled(const Vec3& v, double by) {
    return v * by;
}
Mesh scaled(Mesh mesh, double by) {
    for (Vec3& v : mesh.vertices) {
        v = scaled(v, by);
    }
    return mesh;
}
Element scaled(Element e, double by) {
    e.pose.translation = e.pose.translation * by;
    e.half = e.half * by;
    e.radius *= by;
    if (e.hull) {
        e.hull = convex_hull(scaled(e.hull->surface, by).vertices);
    }
    return e;
}

/// Expects that growth is the same for all that is larger or smaller. By powers of two: numbers differ in their
/// exponents alone, so any step that knows a length would do otherwise.
void expect_that_growth_scales(const Mesh& mesh, const std::vector<Element>& elements) {
    const std::vector<Element> once = grown_over(mesh, elements);
    for (const double by : {0x1p-14, 0x1p14}) {
        std::vector<Element> others;
        for (const Element& e : elements) {
            others.push_back(scaled(e, by));
        }
        const std::vector<Element> after = grown_over(scaled(mesh, by), others);
        for (std::size_t i = 0; i < once.size(); ++i) {
            EXPECT_EQ(after[i].half, once[i].half * by) << by;
            EXPECT_EQ(after[i].radius, once[i].radius * by) << by;
            EXPECT_EQ(after[i].pose.translation, once[i].pose.translation * by) << by;
            EXPECT_EQ(bounds(after[i]).low, bounds(once[i]).low * by) << by;
        }
    }
}

TEST(ElementGrowth, ScalesWithAll) {
    Random random(13);
    const Mesh bar = test::box({-0.05, -0.05, -1}, {0.05, 0.05, 1}), wide = test::box({-1, -1, -0.1}, {1, 1, 0.1});
    for (const Kind kind : {Kind::box, Kind::cylinder, Kind::capsule, Kind::swept_box, Kind::sphere, Kind::hull}) {
        SCOPED_TRACE(to_string(kind));
        std::vector<Element> few{small_one(kind), small_one(kind), small_one(kind)};
        few[0].pose.translation = {0, 0.01, -1};
        few[1].pose.translation = {0.3, 0, 0.9};
        few[2].pose.translation = {-0.8, 0.8, 0.1};
        expect_that_growth_scales(bar, few);
        expect_that_growth_scales(wide, few);
        for (int k = 0; k < 20; ++k) { // one alone, for points that are anywhere
            Element alone = scaled(small_one(kind), 5);
            alone.pose = test::random_pose(random, 2);
            const Vec3 p = alone.pose * (test::random_direction(random) * 4);
            const Vec3 q = alone.pose * (test::random_direction(random) * 2);
            expect_that_growth_scales({{p, p, p, q, q, q}, {{0, 1, 2}, {3, 4, 5}}}, {alone});
        }
        // all but a narrow slit, in a slanted plane; of hulls that are almost alike the last bit decides
        for (const double slit : kind == Kind::hull ? std::vector<double>{} : std::vector{1e-2, 1e-5, 1e-8, 1e-10}) {
            std::vector<Element> halves{scaled(small_one(kind), 5), scaled(small_one(kind), 5)};
            const double reach = kind == Kind::sphere ? 1.5 : 1;
            for (const double side : {-1.0, 1.0}) {
                Element& e = halves[side > 0];
                e.pose = Pose::from_axis_angle(normalized(Vec3{0.1, 1, 0.2}), 0.3);
                e.pose.translation = e.pose.rotate(Vec3{side * (reach + slit / 2), 0, 0});
            }
            expect_that_growth_scales(wide, halves);
        }
    }
}

TEST(ElementGrowth, WhatTwoHoldTogetherAsksForNothing) {
    // Two that hardly overlap, which a cut between them proves, and a part that neither holds.
    const Mesh mesh = test::together(test::box({-0.9, -0.8, -0.8}, {0.9, 0.8, 0.8}), test::box({5, 5, 5}, {6, 6, 6}));
    for (const Kind kind : {Kind::cylinder, Kind::swept_box, Kind::box}) {
        Element left{.kind = kind, .half = {0, 0, 0.5}, .radius = 2}, third = box_between({5, 5, 5}, {6, 6, 5.5});
        if (kind != Kind::cylinder) {
            left.half = kind == Kind::box ? Vec3{0.5, 1, 1} : Vec3{0.4, 1, 1};
            left.radius = kind == Kind::box ? 0 : 0.1;
        } else {
            left.pose = Pose::from_axis_angle({0, 1, 0}, std::numbers::pi / 2);
        }
        Element right = left;
        left.pose.translation.x = -0.5 + 5e-11;
        right.pose.translation.x = 0.5 - 5e-11;
        const std::vector<Element> before{left, right, third}, after = grown_over(mesh, before);
        for (std::size_t i = 0; i < 2; ++i) {
            EXPECT_NEAR(norm(after[i].half - before[i].half), 0, 1e-11) << to_string(kind);
            EXPECT_NEAR(after[i].radius, before[i].radius, 1e-11) << to_string(kind);
        }
        EXPECT_NEAR(volume(after[2]), 1, hair);
    }
}

TEST(ElementGrowth, AHoleInsideATriangleIsClosed) {
    // Capsules along the edges, which hold these: only a part of the inside asks for growth.
    const std::array<Vec3, 3> c{Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{2, 3, 0}};
    const double in = 12 / (4 + 2 * std::sqrt(13.0)); // the radius of the incircle
    std::vector<Element> capsules;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = c[k], b = c[(k + 1) % 3], along = normalized(b - a);
        Element e{.kind = Kind::capsule, .half = {0, 0, norm(b - a) / 2}, .radius = 0.3};
        e.pose.rotation = {Vec3{-along.y, 0, along.x}, Vec3{along.x, 0, along.y}, Vec3{0, 1, 0}};
        e.pose.translation = (a + b) * 0.5;
        capsules.push_back(e);
    }
    const std::vector<Element> after = grown_over(Mesh{{c.begin(), c.end()}, {{0, 1, 2}}}, capsules);
    double most = 0;
    for (const Element& e : after) {
        EXPECT_LE(e.radius, 1.5 * in);
        most = std::max(most, e.radius);
    }
    EXPECT_GE(most, in);
}

TEST(ElementGrowth, SpheresGrowBesideOthers) {
    const auto solid = Solid::make(test::box({-0.1, -0.1, -1}, {0.1, 0.1, 1}));
    Element low = box_between({-1, -1, -1}, {1, 1, 0}), far = low, bad = low;
    bad.half.x = -1;
    far.pose.translation.x = 9;
    const Elements before{{{{0, 0, 0.5}, 0.1}, {{0, 0, -5}, 0.7}, {{0, 0, 5}, -1}}, {low, far, bad}};
    const Elements after = grown_to_cover(*solid, before);
    ASSERT_EQ(after.spheres().size(), 3u);
    ASSERT_EQ(after.size(), 6u);
    EXPECT_NEAR(after.spheres()[0].radius, std::hypot(0.5, 0.1, 0.1), hair);
    EXPECT_NEAR(after.spheres()[1].radius, 0.7, hair);
    EXPECT_EQ(after.spheres()[2], before.spheres()[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(after.spheres()[i].center, before.spheres()[i].center);
    }
    EXPECT_EQ(after[5], bad);
    EXPECT_NEAR(volume(after[3]), volume(low), hair);
    EXPECT_NEAR(volume(after[4]), volume(far), hair);
}

TEST(ElementGrowth, WhatCoversStaysAsItIs) {
    const auto solid = Solid::make(test::box({-1, -1, -1}, {1, 1, 1}));
    const Elements level{{{{}, 0.1}}, {box_between({-1.1, -1.1, -1.1}, {1.1, 1.1, 1.1})}};
    const Elements grown = grown_to_cover(*solid, level);
    EXPECT_EQ(grown, level);
}

TEST(ElementGrowth, WhatIsNotValidStaysAsItIs) {
    const Mesh cube = test::box({-1, -1, -1}, {1, 1, 1});
    Element invalid = box_between({-2, -2, -2}, {2, 2, 2});
    invalid.half.x = -1;
    const std::vector<Element> after = grown_over(cube, {invalid, box_between({-0.5, -1, -1}, {1, 1, 1})});
    EXPECT_EQ(after[0], invalid);
    EXPECT_NEAR(volume(after[1]), 8, hair);
}

} // namespace
