// Elements on a decimal grid: their numbers print short, and they hold what they held.
#include "odd_elements.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <gmock/gmock.h>

namespace foam {
namespace {

using Kind = Element::Kind;
using test::is_on;
using test::odd;

/// Gives the elements the numbers that are written. Returns the largest growth of a length, m.
double finish(const Solid& solid, Elements& elements, bool outer, Numbers numbers) {
    const FinishedTree finished =
        finished_tree(solid, flat_tree(elements), outer ? Guarantee::outer : Guarantee::fitted, false, numbers);
    elements = finished.tree.elements();
    return finished.growth;
}

/// Of a solid for which there is no grid.
constexpr double no_grid = 1e9;

/// Returns the element on the grid of a solid of this size.
Element up_on_grid(const Element& element, double size = 1.5) {
    const auto solid = Solid::make(test::box({0, 0, 0}, Vec3{1, 1, 1} * (size / std::numbers::sqrt3)));
    return padded(*solid, flat_tree(Elements(std::vector{element})), 0).elements()[0];
}

/// Expects that the outer element holds points of the inner one's surface, seen from many sides.
void expect_holds(const Element& outer, const Element& inner) {
    Random random(5);
    for (int k = 0; k < 200; ++k) {
        const Vec3 p = support(inner, test::random_direction(random));
        EXPECT_TRUE(holds(outer, p, -1e-15 * norm(p))) << to_string(inner.kind);
    }
}

class WrittenNumbers : public ::testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, WrittenNumbers,
                         ::testing::Values(Kind::sphere, Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box,
                                           Kind::hull, Kind::ellipsoid),
                         [](const auto& kind) { return to_string(kind.param); });

TEST_P(WrittenNumbers, LengthsAreRoundedUpToTheGrid) {
    const DecimalGrid grid(1);
    const Element before = odd(GetParam(), 1), after = up_on_grid(before);
    expect_holds(after, before);
    EXPECT_EQ(after.kind, before.kind);
    EXPECT_TRUE(is_on(grid, after.radius));
    EXPECT_TRUE(is_on(grid, after.half));
    if (before.hull) {
        EXPECT_EQ(after.pose, Pose{});
        for (const Vec3& v : after.hull->surface.vertices) {
            EXPECT_TRUE(is_on(grid, v));
            EXPECT_LT(distance(before, v), 10 * grid.step());
        }
        return;
    }
    EXPECT_EQ(after.pose, before.pose);
    EXPECT_LT(after.radius - before.radius, grid.step());
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(after.half[axis] - before.half[axis], grid.step());
    }
    EXPECT_EQ(up_on_grid(after), after) << "what is on the grid stays";
}

TEST_P(WrittenNumbers, WithoutAGridNothingMoves) {
    ASSERT_EQ(DecimalGrid(no_grid).step(), 0);
    const Element element = odd(GetParam(), 1);
    EXPECT_EQ(up_on_grid(element, no_grid), element);
}

TEST(WrittenNumbers, ACapsuleOfNoLengthStaysOne) {
    Element capsule = odd(Kind::capsule, 1);
    capsule.half.z = 0;
    const DecimalGrid grid(1);
    EXPECT_EQ(up_on_grid(capsule).half.z, std::max(grid.step(), 1e-6 * up_on_grid(capsule).radius));
    EXPECT_EQ(up_on_grid(capsule, no_grid).half.z, 1e-6 * capsule.radius);
    capsule.radius = 1e3;
    EXPECT_EQ(up_on_grid(capsule).half.z, 1e-3);
    Element cylinder = odd(Kind::cylinder, 1);
    cylinder.half.z = 0;
    EXPECT_EQ(up_on_grid(cylinder).half.z, 0);
}

TEST(WrittenNumbers, SpheresThatCoverGrowByWhatSinglePrecisionLoses) {
    const Sphere far{{100, 0, 0}, 0.5};
    const auto solid = Solid::make(test::box({99.9, -0.1, -0.1}, {100.1, 0.1, 0.1}));
    const DecimalGrid grid(solid->bounds().diagonal());
    Element box{.kind = Kind::box, .half = {0.5, 0.5, 0.5}};
    box.pose.translation = far.center;
    for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
        for (const bool outer : {false, true}) {
            Elements level{{far}, {box}};
            finish(*solid, level, outer, numbers);
            const bool single = outer && numbers == Numbers::float32;
            const double lost = single ? 2 * 100 * std::numeric_limits<float>::epsilon() : 0;
            EXPECT_EQ(level.spheres()[0].radius, grid.up(0.5 + lost));
            EXPECT_EQ(level.spheres()[0].radius > 0.5, single);
        }
    }
}

/// The numbers of an element after reading it from a file in single precision.
Element in_float(Element e) {
    const auto rounded = [](double& x) { x = static_cast<float>(x); };
    for (double* x : {&e.radius, &e.half.x, &e.half.y, &e.half.z, &e.pose.translation.x, &e.pose.translation.y,
                      &e.pose.translation.z}) {
        rounded(*x);
    }
    if (e.hull) {
        std::vector<Vec3> points = e.hull->surface.vertices;
        for (Vec3& p : points) {
            p = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        }
        e.hull = convex_hull(points);
    }
    return e;
}

TEST_P(WrittenNumbers, FinishedElementsCoverAndAreOnTheGrid) {
    for (const double size : {1e-3, 1.0, 30.0}) {
        // The solid is the smallest box around the element, so that the element has to grow.
        const Element start = odd(GetParam(), size);
        const Box box = bounds(start);
        const auto solid = Solid::make(test::box(box.low, box.high));
        const DecimalGrid grid(solid->bounds().diagonal());
        for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
            Elements level(std::vector{start});
            const double growth = finish(*solid, level, true, numbers);
            ASSERT_EQ(level.size(), 1u);
            const Element& e = level[0];
            EXPECT_TRUE(certify(*solid, level).holds) << size;
            EXPECT_TRUE(is_on(grid, e.radius));
            EXPECT_TRUE(is_on(grid, e.half));
            double most = e.radius - start.radius;
            for (int axis = 0; axis < 3; ++axis) {
                most = std::max(most, e.half[axis] - start.half[axis]);
            }
            if (e.hull) {
                for (const Vec3& v : e.hull->surface.vertices) {
                    EXPECT_TRUE(is_on(grid, v));
                    most = std::max(most, distance(start, v));
                }
            }
            EXPECT_GT(growth, 0);
            EXPECT_EQ(growth, most);
            if (numbers == Numbers::float32) {
                const Element read = in_float(e);
                EXPECT_TRUE(certify(*solid, Elements(std::vector<Element>{read})).holds) << size;
            }
        }
    }
}

TEST_P(WrittenNumbers, WhatCoversAlreadyGrowsByNoMoreThanRounding) {
    const auto solid = Solid::make(test::box({0.05, -0.3, 0.25}, {0.2, -0.2, 0.4}));
    const Element start = odd(GetParam(), 1);
    const DecimalGrid grid(solid->bounds().diagonal());
    Elements level(std::vector{start});
    ASSERT_TRUE(covers(*solid, level));
    const double growth = finish(*solid, level, true, Numbers::float64);
    EXPECT_GE(growth, 0);
    EXPECT_LT(growth, GetParam() == Kind::hull ? 5 * grid.step() : 2 * grid.step());
    EXPECT_TRUE(covers(*solid, level));
    if (GetParam() != Kind::hull) {
        EXPECT_EQ(level[0].pose.translation, grid.nearest(start.pose.translation));
    }
}

TEST(WrittenNumbers, WhatIsNotToCoverOnlyMovesToTheGrid) {
    const auto solid = Solid::make(test::box({-9, -9, -9}, {9, 9, 9}));
    const DecimalGrid grid(solid->bounds().diagonal());
    const Element start = odd(Kind::swept_box, 1);
    Elements level{{{{0.1234567891, 0, 0}, 0.2222222222}}, {start}};
    finish(*solid, level, false, Numbers::float32);
    EXPECT_EQ(level.spheres()[0], (Sphere{grid.nearest(Vec3{0.1234567891, 0, 0}), grid.up(0.2222222222)}));
    Element expected = up_on_grid(start, solid->bounds().diagonal());
    expected.pose.translation = grid.nearest(start.pose.translation);
    ASSERT_EQ(level.size(), 2u);
    EXPECT_EQ(level[1], expected);
}

TEST(WrittenNumbers, SpheresBesideElementsCoverWithThem) {
    const auto solid = Solid::make(test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}));
    const DecimalGrid grid(solid->bounds().diagonal());
    Element box = odd(Kind::box, 0.5);
    box.pose = {};
    box.pose.translation = {0.5123456789, 0, 0};
    for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
        Elements level{{{{-0.5123456789, 0, 0}, 0.3333333333}}, {box}};
        const double growth = finish(*solid, level, true, numbers);
        EXPECT_TRUE(covers(*solid, level));
        EXPECT_TRUE(is_on(grid, level.spheres()[0].radius));
        EXPECT_TRUE(is_on(grid, level.spheres()[0].center));
        EXPECT_GE(growth, level.spheres()[0].radius - 0.3333333333);
        EXPECT_GT(level.spheres()[0].radius, 0.5);
        const Element read_box = in_float(level[1]);
        const Vec3& c = level.spheres()[0].center;
        const Sphere read{{static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)},
                          static_cast<float>(level.spheres()[0].radius)};
        if (numbers == Numbers::float32) {
            EXPECT_TRUE(covers(*solid, Elements{{read}, {read_box}}));
        }
    }
}

TEST(WrittenNumbers, WhatFilesLoseIsAddedWhereTheyLoseIt) {
    // Lengths on the grid stay where nothing is lost, and else come up to the next place on it.
    const auto solid = Solid::make(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const DecimalGrid grid(solid->bounds().diagonal());
    const auto finished = [&](Element e, const Pose& pose, Numbers numbers, bool outer = true) {
        e.pose = pose;
        Elements level(std::vector{e});
        finish(*solid, level, outer, numbers);
        return level[0];
    };
    const Pose turned = Pose::from_axis_angle({0, 0, 1}, 0.3);
    const double next = grid.up(0.5 + 0.5 * grid.step());
    for (const Kind kind : {Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box}) {
        Element e{.kind = kind};
        e.radius = kind == Kind::box ? 0 : 0.5;
        e.half = kind == Kind::capsule || kind == Kind::cylinder ? Vec3{0, 0, 0.5} : Vec3{};
        if (kind == Kind::box || kind == Kind::swept_box) {
            e.half = {0.5, 0.5, 0.5};
        }
        const auto length = [&](const Element& of) { return kind == Kind::box ? of.half.x : of.radius; };
        const bool by_ends = kind == Kind::capsule || kind == Kind::cylinder;
        EXPECT_EQ(length(finished(e, {}, Numbers::float64)), by_ends ? next : 0.5) << to_string(kind);
        EXPECT_EQ(length(finished(e, turned, Numbers::float64)), next) << to_string(kind);
        EXPECT_EQ(length(finished(e, turned, Numbers::float64, false)), 0.5) << to_string(kind);
        const double single = length(finished(e, {}, Numbers::float32)) - 0.5;
        const Box box = bounds(e);
        EXPECT_NEAR(single, 8 * std::numeric_limits<float>::epsilon() * norm(box.high), 1.001 * grid.step());
        EXPECT_GE(single, 8 * std::numeric_limits<float>::epsilon() * norm(box.high));
        Pose below; // the farther side counts
        below.translation = {-3, 0, 2};
        const double far = norm({-3 + box.low.x, box.high.y, 2 + box.high.z});
        const auto elsewhere = Solid::make(test::box({-3.1, -0.1, 1.9}, {-2.9, 0.1, 2.1}));
        e.pose = below;
        Elements level(std::vector{e});
        finish(*elsewhere, level, true, Numbers::float32);
        EXPECT_NEAR(length(level[0]) - 0.5, 8 * std::numeric_limits<float>::epsilon() * far,
                    1.001 * grid.step());
    }
}

TEST(WrittenNumbers, AHullHoldsWhatItHeldWhereverItsVerticesMove) {
    // An octahedron whose vertices all move by half a step along each axis where its size happens to be a whole number
    // of steps: its faces fall by half a step's diagonal then.
    const DecimalGrid grid(1);
    const double step = grid.step();
    double most = 0;
    for (const double x : {-0.4995, 0.4995}) {
        for (const double y : {-0.4995, 0.4995}) {
            for (double size = 20; size < 21; size += size > 20.42 && size < 20.63 ? 0.0008 : 0.02) {
                std::vector<Vec3> points;
                for (int axis = 0; axis < 3; ++axis) {
                    for (const double end : {-size, size}) {
                        Vec3 p = Vec3{x, y, 0.4995} * step;
                        p[axis] += end * step;
                        points.push_back(p);
                    }
                }
                const Element before{.kind = Kind::hull, .hull = convex_hull(points)};
                const Element after = up_on_grid(before);
                for (const Vec3& p : points) {
                    EXPECT_TRUE(holds(after, p, -1e-9 * step)) << x << ' ' << y << ' ' << size;
                }
                for (const Vec3& p : after.hull->surface.vertices) {
                    most = std::max(most, distance(before, p));
                }
            }
        }
    }
    EXPECT_LT(most, 2.02 * std::numbers::sqrt3 / 2 * step) << "a face moves out, and then as far with its vertices";
}

TEST(WrittenNumbers, WhatDoesNotCoverHoldsAfterwardsWhatItHeld) {
    const auto solid = Solid::make(test::box({-2, -0.2, -0.2}, {2, 0.2, 0.2}));
    const DecimalGrid grid(solid->bounds().diagonal());
    for (const Kind kind : every_kind()) {
        for (int k = 0; k < 20; ++k) {
            const double shift = 0.0500012345 * k; // the nearest numbers on the grid are on either side
            Element element = odd(kind, 0.5);
            element.pose.translation.x = 3 + shift * 1.1; // beside the solid: there is nothing for it to grow for
            const Sphere idle{{-3 - shift, shift, 2 + shift * 0.7}, 0.1 + shift * 0.1};
            const Element around{.kind = Kind::box, .half = {1.99, 1, 1}};
            Elements level{{idle}, {element, around}};
            finish(*solid, level, true, Numbers::float64);
            ASSERT_TRUE(covers(*solid, level));
            const Sphere& after = level.spheres()[0];
            EXPECT_GE(after.radius, idle.radius + distance(after.center, idle.center) - 1e-15);
            EXPECT_LE(after.radius, idle.radius + 3 * grid.step());
            expect_holds(level[1], element);
        }
    }
}

TEST(WrittenNumbers, TheGrowthIsThatOfTheSphereThatGrowsMost) {
    const auto solid = Solid::make(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const DecimalGrid grid(solid->bounds().diagonal());
    const Element box{.kind = Kind::box, .half = {0.5, 0.5, 0.5}}; // on the grid
    const double most = 0.2 + 0.1 * grid.step(), less = 0.3 + 0.8 * grid.step();
    for (const auto& [a, b] : {std::pair{most, less}, std::pair{less, most}}) {
        Elements level{{{{}, a}, {{}, b}}, {box}};
        EXPECT_EQ(finish(*solid, level, true, Numbers::float64), grid.up(most) - most);
        EXPECT_EQ(level[2], box);
    }
}

TEST(WrittenNumbers, TheGrowthIsThatOfTheElementThatGrowsMost) {
    const auto solid = Solid::make(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const DecimalGrid grid(solid->bounds().diagonal());
    const Element whole{.kind = Kind::box, .half = {0.5, 0.5, 0.5}}; // on the grid
    for (int axis = 0; axis < 4; ++axis) {
        Element less{.kind = axis < 3 ? Kind::box : Kind::sphere, .half = whole.half};
        less.half = axis < 3 ? whole.half : Vec3{};
        double& length = axis < 3 ? less.half[axis] : less.radius;
        length = 0.5 - 0.3 * grid.step();
        const double growth = 0.5 - length;
        for (const auto& elements : {std::vector{whole, less}, std::vector{less, whole}}) {
            Elements level(elements);
            EXPECT_EQ(finish(*solid, level, true, Numbers::float64), growth) << axis;
        }
    }
}

TEST(WrittenNumbers, ElementsThatTouchOverlapAfterwards) {
    // Halves of a box whose common plane is on no grid.
    const auto solid = Solid::make(test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}));
    const double plane = 0.0123456789;
    std::vector<Element> halves;
    for (const auto& [from, to] : {std::pair{-1.0, plane}, std::pair{plane, 1.0}}) {
        Element e{.kind = Kind::box, .half = {(to - from) / 2, 0.2, 0.2}};
        e.pose.translation = {(from + to) / 2, 0, 0};
        halves.push_back(e);
    }
    const DecimalGrid grid(solid->bounds().diagonal());
    Elements level(halves);
    const double growth = finish(*solid, level, true, Numbers::float64);
    EXPECT_TRUE(covers(*solid, level));
    EXPECT_LT(growth, 20 * grid.step());
    for (const Element& e : level) {
        EXPECT_TRUE(is_on(grid, e.half));
        EXPECT_TRUE(is_on(grid, e.pose.translation));
    }
}

TEST(WrittenNumbers, AHullThinnerThanTheStepIsGrownBeforeItIsRounded) {
    const DecimalGrid grid(std::numbers::sqrt2 / 2);
    const double thin = 0.2 * grid.step();
    const auto solid = Solid::make(test::box({0, 0, 0}, {0.5, 0.5, thin}));
    Element hull{.kind = Kind::hull};
    hull.hull = convex_hull(solid->surface().vertices);
    Elements level(std::vector{hull});
    const double growth = finish(*solid, level, true, Numbers::float64);
    EXPECT_TRUE(covers(*solid, level));
    EXPECT_LT(growth, 20 * grid.step());
    for (const Vec3& v : level[0].hull->surface.vertices) {
        EXPECT_TRUE(is_on(grid, v));
    }
}

} // namespace
} // namespace foam
