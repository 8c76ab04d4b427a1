// Queries and figures of convex elements, each against another way to the same answer.
#include "plain_shapes.hpp"

#include <foam/geometry/measure.hpp>

#include <gtest/gtest.h>

using namespace foam;
using Kind = Element::Kind;

namespace {

Element random_element(Kind kind, Random& random) {
    Element e;
    e.kind = kind;
    e.pose = test::random_pose(random, 1);
    const auto length = [&] { return random.uniform(0.1, 1); };
    e.radius = kind == Kind::box || kind == Kind::hull || kind == Kind::ellipsoid ? 0 : length();
    if (kind == Kind::capsule || kind == Kind::cylinder) {
        e.half.z = length();
    } else if (kind == Kind::box || kind == Kind::swept_box || kind == Kind::ellipsoid) {
        e.half = {length(), length(), length()};
    } else if (kind == Kind::hull) {
        std::vector<Vec3> points;
        for (int i = 0; i < 30; ++i) {
            points.push_back(test::random_point(random, {{-1, -0.5, 0}, {1, 0.5, 0.7}}));
        }
        e.hull = convex_hull(points);
    }
    return e;
}

class EveryKind : public ::testing::TestWithParam<Kind> {
protected:
    Random random{derive_seed(11, to_string(GetParam()))};
};
INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind,
                         ::testing::Values(Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box,
                                           Kind::hull, Kind::ellipsoid),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(EveryKind, WordsNameKinds) {
    EXPECT_EQ(element_kind_named(to_string(GetParam())), GetParam());
    EXPECT_FALSE(element_kind_named("balls"));
}

TEST_P(EveryKind, SupportIsTheFarthestPointAndBoundsAreTight) {
    for (int run = 0; run < 50; ++run) {
        const Element e = random_element(GetParam(), random);
        ASSERT_TRUE(is_valid(e));
        const Box box = bounds(e);
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 d{};
            d[axis] = 1;
            EXPECT_NEAR(support(e, d)[axis], box.high[axis], 1e-12);
            EXPECT_NEAR(support(e, -d)[axis], box.low[axis], 1e-12);
        }
        for (int k = 0; k < 50; ++k) {
            const Vec3 d = test::random_direction(random), p = support(e, d);
            EXPECT_NEAR(distance(e, p), 0, 1e-12);
            EXPECT_GT(distance(e, p + d * 0.01), e.hull ? 0 : 0.0099); // a hull: from a plane
            const Vec3 q = test::random_point(random, box);
            if (holds(e, q)) {
                EXPECT_LE(dot(d, q), dot(d, p) + 1e-12);
            }
        }
    }
}

TEST_P(EveryKind, LinesEnterAndLeaveWherePointsDo) {
    for (int run = 0; run < 300; ++run) {
        const Element e = random_element(GetParam(), random);
        const Box box = test::enlarged(bounds(e), 0.3);
        const Vec3 o = test::random_point(random, box), d = test::random_direction(random) * random.uniform(0.5, 2);
        const auto part = inside_along(e, o, d);
        for (int k = 0; k < 40; ++k) {
            const double t = random.uniform(-4, 4);
            const bool inside = part && t > part->enter && t < part->leave;
            const bool near = part && std::min(std::abs(t - part->enter), std::abs(t - part->leave)) < 1e-9;
            EXPECT_TRUE(near || inside == holds(e, o + d * t)) << t;
        }
    }
}

TEST_P(EveryKind, GrowthContainsWhatIsWithinTheLength) {
    for (int run = 0; run < 50; ++run) {
        const Element e = random_element(GetParam(), random);
        for (const double length : {0.0, 1e-12, 1e-6, 0.3}) {
            const Element more = grown(e, length);
            ASSERT_EQ(more.kind, e.kind);
            ASSERT_TRUE(is_valid(more));
            for (int k = 0; k < 40; ++k) {
                const Vec3 d = test::random_direction(random);
                EXPECT_TRUE(holds(more, support(e, d) + d * length, -1e-14)) << length;
            }
            if (e.hull) {
                EXPECT_LE(more.hull->surface.vertices.size(), e.hull->surface.vertices.size());
            }
        }
    }
}

TEST_P(EveryKind, MeshesEncloseAndVolumesAgree) {
    for (int run = 0; run < 5; ++run) {
        const Element e = random_element(GetParam(), random);
        const Mesh mesh = enclosing_mesh(e, 24);
        EXPECT_TRUE(topology(mesh).closed_manifold());
        const auto solid = Solid::make(mesh);
        for (int k = 0; k < 200; ++k) {
            EXPECT_LE(solid->signed_distance(support(e, test::random_direction(random))), 1e-12);
        }
        const double exact = volume(e);
        EXPECT_GE(solid->volume(), exact * (1 - 1e-12));
        EXPECT_LE(solid->volume(), exact * 1.03);
        // by lines: two of them at one place
        const std::vector<Element> twice{e, e};
        EXPECT_NEAR(union_volume(Elements(twice)), exact, 4e-3 * exact);
        EXPECT_NEAR(union_volume(Elements(std::vector<Element>{e})), exact, 1e-12 * exact);
        // the mesh lies in an element a little larger, with the excess of it
        const Element around = grown(e, 0.2);
        const Measures m = measure(*solid, Elements(std::vector<Element>{around}));
        EXPECT_TRUE(m.certified);
        EXPECT_EQ(m.gap, 0);
        EXPECT_EQ(m.missing, 0);
        EXPECT_NEAR(m.excess_volume, volume(around) - solid->volume(), 1e-9);
        EXPECT_NEAR(excess_volume(*solid, Elements(std::vector<Element>{around})), m.excess_volume, 1e-9);
        EXPECT_GE(m.protrusion_max, m.protrusion_mean);
        EXPECT_LE(m.protrusion_mean, 0.35 * 2);
        // a smaller one leaves some of it out, and its surface does not protrude
        Element inside = e;
        inside.pose = e.pose;
        if (e.kind != Kind::hull) {
            inside.radius *= 0.8;
            inside.half *= 0.8;
            const Measures less = measure(*solid, Elements(std::vector<Element>{inside}));
            EXPECT_FALSE(less.certified);
            EXPECT_NEAR(less.missing_volume, solid->volume() - volume(inside), 5 * less.missing_volume_error + 1e-9);
            EXPECT_NEAR(less.excess_volume, 0, 1e-9);
            EXPECT_EQ(less.protrusion_max, 0);
            EXPECT_GT(less.gap, 0);
            EXPECT_LT(less.covered, 0.01);
        }
    }
}

TEST(ElementFigures, ABoxAroundABox) {
    const auto solid = Solid::make(test::box({-1, -1, -1}, {1, 1, 1}));
    Element box{.kind = Kind::box, .half = {1.1, 1.1, 1.1}};
    const Measures m = measure(*solid, Elements(std::vector<Element>{box}));
    EXPECT_TRUE(m.certified);
    EXPECT_EQ(m.spheres, 1u);
    EXPECT_NEAR(m.excess, 1.331 - 1, 1e-9);
    EXPECT_NEAR(m.protrusion_max, 0.1 * std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(m.exposed_area, 6 * 2.2 * 2.2, 1e-9);
    EXPECT_GT(m.protrusion_mean, 0.1);
    EXPECT_LT(m.protrusion_mean, 0.11);
    // Two halves with a common plane: it is not a part of the surface.
    std::vector<Element> halves{box, box};
    halves[0].half.x = halves[1].half.x = 0.55;
    halves[0].pose.translation.x = -0.55;
    halves[1].pose.translation.x = 0.55;
    const Measures two = measure(*solid, Elements(halves));
    EXPECT_NEAR(two.exposed_area, m.exposed_area, 1e-6);
    EXPECT_NEAR(two.excess, m.excess, 1e-6);
    EXPECT_NEAR(two.protrusion_max, m.protrusion_max, 1e-9);
}

TEST(ElementFigures, SpheresKeepTheirResults) {
    const auto solid = Solid::make(test::ball({0, 0, 0}, 0.5, 12));
    const std::vector<Sphere> spheres{{{0.1, 0, 0}, 0.55}, {{-0.2, 0, 0}, 0.4}};
    const Measures a = measure(*solid, spheres), b = measure(*solid, Elements(spheres));
    EXPECT_EQ(a.excess, b.excess);
    EXPECT_EQ(a.gap, b.gap);
    EXPECT_EQ(a.protrusion_mean, b.protrusion_mean);
    EXPECT_EQ(solid->missing_volume(spheres), missing_volume(*solid, Elements(spheres)));
        EXPECT_EQ(grown_to_cover(*solid, spheres), grown_to_cover(*solid, Elements(spheres)).spheres());
    Element ball;
    ball.pose.translation = {0.3, 0, 0};
    ball.radius = 0.2;
    const Approximation flat = flat_tree({spheres, {ball}});
    EXPECT_EQ(flat.levels[1].parents.size(), 3u);
    EXPECT_LE(distance(flat.levels[0].elements.spheres()[0].center, ball.pose.translation) + 0.2,
              flat.levels[0].elements.spheres()[0].radius * (1 + 1e-9));
}

} // namespace
