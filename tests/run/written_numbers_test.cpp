// Elements on a decimal grid: their numbers print short, and they hold what they held.
#include "geometry/plain_shapes.hpp"
#include "runtime/src/finish/finish.hpp"

#include <foam/geometry/measure.hpp>

#include <gmock/gmock.h>

namespace foam {
namespace {

using Kind = Element::Kind;
using ::testing::ElementsAre;

bool is_on(const DecimalGrid& grid, double value) {
    return grid.nearest(value) == value;
}
bool is_on(const DecimalGrid& grid, const Vec3& v) {
    return grid.nearest(v) == v;
}

/// An element of a kind whose numbers are on no grid.
Element odd(Kind kind, double size) {
    Element e;
    e.kind = kind;
    e.pose = Pose::from_axis_angle(normalized({1, 2, 3}), 0.7);
    e.pose.translation = Vec3{0.1234567891, -0.2345678912, 0.3456789123} * size;
    if (kind == Kind::hull) {
        Random random(3);
        std::vector<Vec3> points;
        for (int k = 0; k < 12; ++k) {
            points.push_back(test::random_direction(random) * (size * random.uniform(0.8, 1)));
        }
        e.hull = convex_hull(points);
        return e;
    }
    e.radius = kind == Kind::box || kind == Kind::ellipsoid ? 0 : 0.4444444444 * size;
    if (kind == Kind::box || kind == Kind::swept_box || kind == Kind::ellipsoid) {
        e.half = Vec3{0.5555555555, 0.6666666666, 0.7777777777} * size;
    } else if (kind != Kind::sphere) {
        e.half.z = 0.8888888888 * size;
    }
    return e;
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
    const Element before = odd(GetParam(), 1), after = up_on_grid(before, grid);
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
    EXPECT_EQ(up_on_grid(after, grid), after) << "what is on the grid stays";
}

TEST_P(WrittenNumbers, WithoutAGridNothingMoves) {
    const DecimalGrid none(1e30);
    ASSERT_EQ(none.step(), 0);
    const Element element = odd(GetParam(), 1);
    EXPECT_EQ(up_on_grid(element, none), element);
}

TEST(WrittenNumbers, ACapsuleOfNoLengthStaysOne) {
    Element capsule = odd(Kind::capsule, 1);
    capsule.half.z = 0;
    const DecimalGrid grid(1), none(1e30);
    EXPECT_EQ(up_on_grid(capsule, grid).half.z, std::max(grid.step(), 1e-6 * up_on_grid(capsule, grid).radius));
    EXPECT_EQ(up_on_grid(capsule, none).half.z, 1e-6 * capsule.radius);
    capsule.radius = 1e3;
    EXPECT_EQ(up_on_grid(capsule, grid).half.z, 1e-3);
    Element cylinder = odd(Kind::cylinder, 1);
    cylinder.half.z = 0;
    EXPECT_EQ(up_on_grid(cylinder, grid).half.z, 0);
}

TEST(WrittenNumbers, SinglePrecisionTakesTwoOfItsUnits) {
    const double unit = std::numeric_limits<float>::epsilon();
    for (const Sphere& s : {Sphere{{4, 1, 2}, 3}, Sphere{{1, -4, 2}, 3}, Sphere{{1, 2, -4}, 3}, Sphere{{1, 2, 3}, 4},
                            Sphere{{-4, 1, 2}, 3}}) {
        EXPECT_EQ(float32_slack(s, Numbers::float32), 8 * unit);
        EXPECT_EQ(float32_slack(s, Numbers::float64), 0);
    }
}

TEST(WrittenNumbers, SpheresThatCoverGrowByWhatSinglePrecisionLoses) {
    const Sphere far{{100, 0, 0}, 0.5};
    const auto solid = Solid::make(test::box({99.9, -0.1, -0.1}, {100.1, 0.1, 0.1}));
    const DecimalGrid grid(1);
    Element box{.kind = Kind::box, .half = {0.5, 0.5, 0.5}};
    box.pose.translation = far.center;
    for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
        for (const bool outer : {false, true}) {
            Elements level{{far}, {box}};
            finish_elements(*solid, level, grid, outer, numbers);
            const double lost = outer ? float32_slack(far, numbers) : 0;
            EXPECT_EQ(level.spheres()[0].radius, grid.up(0.5 + lost));
            EXPECT_EQ(level.spheres()[0].radius > 0.5, outer && numbers == Numbers::float32);
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
            const double growth = finish_elements(*solid, level, grid, true, numbers);
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
    const DecimalGrid grid(1);
    Elements level(std::vector{start});
    ASSERT_TRUE(covers(*solid, level));
    const double growth = finish_elements(*solid, level, grid, true, Numbers::float64);
    EXPECT_GE(growth, 0);
    EXPECT_LT(growth, GetParam() == Kind::hull ? 5 * grid.step() : 2 * grid.step());
    EXPECT_TRUE(covers(*solid, level));
    if (GetParam() != Kind::hull) {
        EXPECT_EQ(level[0].pose.translation, grid.nearest(start.pose.translation));
    }
}

TEST(WrittenNumbers, WhatIsNotToCoverOnlyMovesToTheGrid) {
    const auto solid = Solid::make(test::box({-9, -9, -9}, {9, 9, 9}));
    const DecimalGrid grid(1);
    const Element start = odd(Kind::swept_box, 1);
    Elements level{{{{0.1234567891, 0, 0}, 0.2222222222}}, {start}};
    finish_elements(*solid, level, grid, false, Numbers::float32);
    EXPECT_EQ(level.spheres()[0], (Sphere{grid.nearest(Vec3{0.1234567891, 0, 0}), grid.up(0.2222222222)}));
    Element expected = up_on_grid(start, grid);
    expected.pose.translation = grid.nearest(start.pose.translation);
    ASSERT_EQ(level.size(), 2u);
    EXPECT_EQ(level[1], expected);
}

TEST(WrittenNumbers, SpheresBesideElementsCoverWithThem) {
    const auto solid = Solid::make(test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}));
    const DecimalGrid grid(2);
    Element box = odd(Kind::box, 0.5);
    box.pose = {};
    box.pose.translation = {0.5123456789, 0, 0};
    for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
        Elements level{{{{-0.5123456789, 0, 0}, 0.3333333333}}, {box}};
        const double growth = finish_elements(*solid, level, grid, true, numbers);
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
    const DecimalGrid grid(1);
    const auto finished = [&](Element e, const Pose& pose, Numbers numbers, bool outer = true) {
        e.pose = pose;
        Elements level(std::vector{e});
        finish_elements(*solid, level, grid, outer, numbers);
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
        finish_elements(*elsewhere, level, grid, true, Numbers::float32);
        EXPECT_NEAR(length(level[0]) - 0.5, 8 * std::numeric_limits<float>::epsilon() * far,
                    1.001 * grid.step());
    }
}

TEST(WrittenNumbers, WithoutAGridElementsGrowByWhatFilesLose) {
    const DecimalGrid none(1e30);
    for (const Vec3& place : {Vec3{-3, 1, 2}, Vec3{3, -1.5, -2}, Vec3{0.5, 2, -4}}) {
        const auto solid = Solid::make(test::box(place - Vec3{0.1, 0.1, 0.1}, place + Vec3{0.1, 0.1, 0.1}));
        for (const Kind kind : {Kind::capsule, Kind::cylinder, Kind::box, Kind::swept_box}) {
            for (const bool turned : {false, true}) {
                Element e = odd(kind, 1);
                e.pose = turned ? Pose::from_axis_angle({0, 0, 1}, 0.3) : Pose{};
                e.pose.translation = place;
                const Box box = bounds(e);
                const auto far = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
                const double size =
                    norm({far(box.low.x, box.high.x), far(box.low.y, box.high.y), far(box.low.z, box.high.z)});
                const bool by_ends = kind == Kind::capsule || kind == Kind::cylinder;
                for (const Numbers numbers : {Numbers::float64, Numbers::float32}) {
                    Elements level(std::vector{e});
                    const double growth = finish_elements(*solid, level, none, true, numbers);
                    const double lost = numbers == Numbers::float32 ? size * 0x1p-20 : by_ends || turned ? size * 1e-12 : 0;
                    const Element& after = level[0];
                    EXPECT_NEAR(growth, lost, 1e-15) << to_string(kind);
                    EXPECT_NEAR(after.radius - e.radius, kind == Kind::box ? 0 : lost, 1e-15) << to_string(kind);
                    const bool longer = kind == Kind::box || kind == Kind::cylinder;
                    EXPECT_NEAR(after.half.z - e.half.z, longer ? lost : 0, 1e-15) << to_string(kind);
                }
            }
        }
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
                const Element after = up_on_grid(before, grid);
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
    const DecimalGrid grid(4);
    for (const Kind kind : every_kind()) {
        for (int k = 0; k < 20; ++k) {
            const double shift = 0.0500012345 * k; // the nearest numbers on the grid are on either side
            Element element = odd(kind, 0.5);
            element.pose.translation.x = 3 + shift * 1.1; // beside the solid: there is nothing for it to grow for
            const Sphere idle{{-3 - shift, shift, 2 + shift * 0.7}, 0.1 + shift * 0.1};
            const Element around{.kind = Kind::box, .half = {1.99, 1, 1}};
            Elements level{{idle}, {element, around}};
            finish_elements(*solid, level, grid, true, Numbers::float64);
            ASSERT_TRUE(covers(*solid, level));
            const Sphere& after = level.spheres()[0];
            EXPECT_GE(after.radius, idle.radius + distance(after.center, idle.center) - 1e-15);
            EXPECT_LE(after.radius, idle.radius + 3 * grid.step());
            expect_holds(level[1], element);
        }
    }
}

TEST(WrittenNumbers, ElementsGrowUntilTheyAreProvedBySteps) {
    const auto solid = Solid::make(test::box({-1, -0.1, -0.1}, {1, 0.1, 0.1}));
    const DecimalGrid grid(2), none(1e30);
    const double step = grid.step(), least = 1e-10 * solid->bounds().diagonal();
    // One step, two more, four more, ... : after n rounds 2^n - 1.
    for (const DecimalGrid& on : {grid, none}) {
        const double unit = on.step() > 0 ? step : least;
        for (const int missing : {-1, 0, 2, 6, 100, 4000, 4100}) {
            Element half{.kind = Kind::box, .half = {0.5, 0.2, 0.2}};
            half.pose.translation = {0.5, 0, 0};
            const Sphere ball{{-0.5, 0, 0}, std::sqrt(0.25 + 0.02) - missing * unit + unit / 2};
            half.half.x = 0.5 - missing * unit + unit / 2; // what overlaps covers, but for the ends
            const int rounds = missing <= 0 ? 0 : static_cast<int>(std::ceil(std::log2(missing + 0.5)));
            const double expected = missing > 4095 ? 4095 : std::ldexp(1, rounds) - 1;
            Elements level{{ball}, {half}};
            grow_until_proved(*solid, level, on);
            EXPECT_EQ(covers(*solid, level), missing < 4100) << missing;
            EXPECT_NEAR(level.spheres()[0].radius, ball.radius + expected * unit, 1.1 * rounds * on.step() + 1e-15) << missing;
            EXPECT_NEAR(level[1].half.x, half.half.x + expected * unit, 1.1 * rounds * on.step() + 1e-15) << missing;
            if (rounds > 0) {
                EXPECT_TRUE(is_on(on, level.spheres()[0].radius));
                EXPECT_TRUE(is_on(on, level[1].half.x));
            }
        }
    }
}

TEST(WrittenNumbers, TheGrowthIsThatOfTheSphereThatGrowsMost) {
    const auto solid = Solid::make(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const DecimalGrid grid(1);
    const Element box{.kind = Kind::box, .half = {0.5, 0.5, 0.5}}; // on the grid
    const double most = 0.2 + 0.1 * grid.step(), less = 0.3 + 0.8 * grid.step();
    for (const auto& [a, b] : {std::pair{most, less}, std::pair{less, most}}) {
        Elements level{{{{}, a}, {{}, b}}, {box}};
        EXPECT_EQ(finish_elements(*solid, level, grid, true, Numbers::float64), grid.up(most) - most);
        EXPECT_EQ(level[2], box);
    }
}

TEST(WrittenNumbers, TheGrowthIsThatOfTheElementThatGrowsMost) {
    const auto solid = Solid::make(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const DecimalGrid grid(1);
    const Element whole{.kind = Kind::box, .half = {0.5, 0.5, 0.5}}; // on the grid
    for (int axis = 0; axis < 4; ++axis) {
        Element less{.kind = axis < 3 ? Kind::box : Kind::sphere, .half = whole.half};
        less.half = axis < 3 ? whole.half : Vec3{};
        double& length = axis < 3 ? less.half[axis] : less.radius;
        length = 0.5 - 0.3 * grid.step();
        const double growth = 0.5 - length;
        for (const auto& elements : {std::vector{whole, less}, std::vector{less, whole}}) {
            Elements level(elements);
            EXPECT_EQ(finish_elements(*solid, level, grid, true, Numbers::float64), growth) << axis;
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
    const DecimalGrid grid(2);
    Elements level(halves);
    const double growth = finish_elements(*solid, level, grid, true, Numbers::float64);
    EXPECT_TRUE(covers(*solid, level));
    EXPECT_LT(growth, 20 * grid.step());
    for (const Element& e : level) {
        EXPECT_TRUE(is_on(grid, e.half));
        EXPECT_TRUE(is_on(grid, e.pose.translation));
    }
}

TEST(WrittenNumbers, AHullThinnerThanTheStepIsGrownBeforeItIsRounded) {
    const DecimalGrid grid(1);
    const double thin = 0.2 * grid.step();
    const auto solid = Solid::make(test::box({0, 0, 0}, {0.5, 0.5, thin}));
    Element hull{.kind = Kind::hull};
    hull.hull = convex_hull(solid->surface().vertices);
    Elements level(std::vector{hull});
    const double growth = finish_elements(*solid, level, grid, true, Numbers::float64);
    EXPECT_TRUE(covers(*solid, level));
    EXPECT_LT(growth, 20 * grid.step());
    for (const Vec3& v : level[0].hull->surface.vertices) {
        EXPECT_TRUE(is_on(grid, v));
    }
}

} // namespace
} // namespace foam
