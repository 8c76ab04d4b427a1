// The numbers that go into files: rounded so that they print short and the proof still holds, at sizes of every
// exponent.
#include "geometry/shapes.hpp"

#include <foam/base/error.hpp>
#include <foam/base/text.hpp>
#include <foam/geometry/inner.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/runtime/internal/cover.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

/// The step of the decimal grid of a solid of this size: 10^-6 of the power of ten below it; 0 where there is none.
double step_of(double size) {
    const int exponent = static_cast<int>(std::floor(std::log10(size))) - 6;
    return exponent < -22 || exponent > 0 ? 0 : *parse_number("1e" + std::to_string(exponent));
}

/// Digits after which a number's zeros begin.
std::size_t digits_of(double value) {
    std::string text = number_text(value);
    text = text.substr(0, text.find('e'));
    std::erase_if(text, [](char c) { return c == '.' || c == '-'; });
    text.erase(0, text.find_first_not_of('0'));
    return text.size();
}

std::shared_ptr<const Solid> cube(double size) {
    return Solid::make(test::box({-size / 2, -size / 2, -size / 2}, {size / 2, size / 2, size / 2}));
}

/// Balls about points that no grid has, which cover a cube of this size or nearly so.
std::vector<Sphere> balls_in_cube(Random& random, double size) {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 8; ++i) {
        const auto at = [&](bool high) { return size * ((high ? 0.25 : -0.25) + random.uniform(-0.05, 0.05)); };
        spheres.push_back({{at(i & 1), at(i & 2), at(i & 4)}, size * random.uniform(0.3, 0.45)});
    }
    return spheres;
}

double volume(double radius) {
    return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

} // namespace

TEST(FinishedTree, OuterNumbersAreOnAGridAndStillCover) {
    Random random(1);
    for (int exponent = -24; exponent <= 8; ++exponent) {
        for (const double factor :
             {1.0, 3.7, 0.5774}) { // the diagonal of the last is just above and below a power of ten
            const double size = factor * std::pow(10, exponent);
            const auto solid = cube(size);
            const std::vector<Sphere> given = balls_in_cube(random, size);
            const FinishedTree finished = finished_tree(*solid, flat_tree(given), Guarantee::outer, false);
            const std::vector<Sphere>& spheres = finished.tree.finest();
            const double step = step_of(solid->bounds().diagonal());
            ASSERT_EQ(spheres.size(), given.size());
            EXPECT_TRUE(certify(*solid, spheres).holds) << size;
            EXPECT_FALSE(finished.one_instead);
            std::vector<Sphere> on_grid = given;
            double growth = 0;
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                on_grid[i].center = spheres[i].center;
                growth = std::max(growth, spheres[i].radius - given[i].radius);
                for (int axis = 0; axis < 3; ++axis) {
                    const double number = spheres[i].center[axis];
                    EXPECT_LE(std::abs(number - given[i].center[axis]), 0.5001 * step) << "the nearest";
                    EXPECT_TRUE(step == 0 || digits_of(number) <= 8) << number_text(number);
                    EXPECT_EQ(parse_number(number_text(number)), number);
                }
                EXPECT_TRUE(step == 0 || digits_of(spheres[i].radius) <= 8) << number_text(spheres[i].radius);
            }
            EXPECT_DOUBLE_EQ(finished.growth, growth);
            const std::vector<Sphere> grown = grown_to_cover(*solid, on_grid);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                EXPECT_GE(spheres[i].radius, grown[i].radius) << "rounded up, by less than a step";
                EXPECT_LE(spheres[i].radius, grown[i].radius + step * 1.0001);
            }
        }
    }
}

TEST(FinishedTree, RadiiThatRoundingBringsBelowAreTakenAStepUp) {
    // Radii a last bit above a number of the grid, and on it.
    Random random(2);
    const auto solid = cube(1);
    std::size_t stay = 0;
    for (int round = 0; round < 20; ++round) {
        std::vector<Sphere> given;
        for (int i = 0; i < 200; ++i) {
            const double on_grid = *parse_number(number_text(std::round(random.uniform(1, 3) * 1e6)) + "e-6");
            given.push_back({{}, i % 3 == 0 ? on_grid : std::nextafter(on_grid, i % 3 == 1 ? 9 : 0)});
        }
        const std::vector<Sphere> spheres =
            finished_tree(*solid, flat_tree(given), Guarantee::outer, false).tree.finest();
        for (std::size_t i = 0; i < given.size(); ++i) {
            EXPECT_GE(spheres[i].radius, given[i].radius);
            EXPECT_LE(spheres[i].radius, given[i].radius + 1.001e-6);
            EXPECT_LE(digits_of(spheres[i].radius), 7u);
            stay += spheres[i].radius == given[i].radius;
        }
    }
    EXPECT_GT(stay, 1000u) << "most of those that are on the grid";
}

TEST(FinishedTree, InnerNumbersAreOnAGridAndStillInside) {
    Random random(3);
    for (int exponent = -24; exponent <= 8; ++exponent) {
        for (const double factor : {1.0, 3.7, 0.5774}) {
            const double size = factor * std::pow(10, exponent);
            const auto solid = cube(size);
            const std::vector<Sphere> given = balls_in_cube(random, size);
            const FinishedTree finished = finished_tree(*solid, flat_tree(given), Guarantee::inner);
            const std::vector<Sphere>& spheres = finished.tree.finest();
            const double step = step_of(solid->bounds().diagonal());
            ASSERT_EQ(spheres.size(), given.size());
            EXPECT_TRUE(certify_inner(*solid, spheres).holds) << size;
            std::vector<Sphere> fitted = shrunk_to_fit(*solid, given);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                fitted[i].center = spheres[i].center;
                EXPECT_LE(distance(fitted[i].center, given[i].center), 0.8662 * step);
                for (int axis = 0; axis < 3; ++axis) {
                    EXPECT_TRUE(step == 0 || digits_of(spheres[i].center[axis]) <= 8) << number_text(spheres[i].center[axis]);
                }
                EXPECT_TRUE(step == 0 || digits_of(spheres[i].radius) <= 8) << number_text(spheres[i].radius);
            }
            const std::vector<double> room = inner_radii(*solid, fitted);
            for (std::size_t i = 0; i < spheres.size(); ++i) {
                EXPECT_LE(spheres[i].radius, room[i]) << "rounded down, by less than a step";
                EXPECT_GE(spheres[i].radius, room[i] - step * 1.0001);
            }
        }
    }
}

TEST(FinishedTree, InnerRadiiOnTheGridStay) {
    Random random(4);
    const auto solid = cube(9);
    std::vector<Sphere> given;
    for (int i = 0; i < 600; ++i) {
        const double on_grid = *parse_number(number_text(std::round(random.uniform(0.1, 4) * 1e5)) + "e-5");
        given.push_back({{}, i % 3 == 0 ? on_grid : std::nextafter(on_grid, i % 3 == 1 ? 9 : 0)});
    }
    std::size_t stay = 0;
    ASSERT_GT(solid->bounds().diagonal(), 10);
    for (const Sphere& sphere : given) {
        const std::vector<Sphere> one = finished_tree(*solid, flat_tree({sphere}), Guarantee::inner).tree.finest();
        ASSERT_EQ(one.size(), 1u);
        EXPECT_LE(one[0].radius, sphere.radius);
        EXPECT_GE(one[0].radius, sphere.radius - 1.001e-5);
        EXPECT_LE(digits_of(one[0].radius), 6u);
        stay += one[0].radius == sphere.radius;
    }
    EXPECT_GT(stay, 150u) << "most of those that are on the grid";
}

TEST(FinishedTree, ZeroIsNeverNegative) {
    const auto solid = cube(1);
    const auto spheres =
        finished_tree(*solid, flat_tree({{{-1e-9, -0.0, 1e-9}, 1}}), Guarantee::outer, false).tree.finest();
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(number_text(spheres[0].center[axis]), "0");
    }
}

TEST(FinishedTree, OfASolidWithoutSizeTheGridIsANanometre) {
    const auto point = Solid::make(Mesh{{{0, 0, 0}}, {{0, 0, 0}}});
    ASSERT_EQ(point->bounds().diagonal(), 0);
    const FinishedTree finished =
        finished_tree(*point, flat_tree({{{0.1234567894, -0.1234567894, 0}, 0.3000000004}}), Guarantee::outer, false);
    EXPECT_EQ(finished.tree.finest()[0].center, (Vec3{0.123456789, -0.123456789, 0}));
    EXPECT_EQ(finished.tree.finest()[0].radius, 0.300000001);
}

TEST(FinishedTree, EveryLevelCovers) {
    const auto solid = cube(1);
    SphereTree tree;
    tree.levels = {{{{{0.01, 0, 0}, 0.1}}, {}}, {{{{-0.3, 0, 0}, 0.5}, {{0.3, 0, 0}, 0.5}}, {0, 0}}};
    const FinishedTree finished = finished_tree(*solid, tree, Guarantee::outer, false);
    ASSERT_EQ(finished.tree.levels.size(), 2u);
    for (const SphereTree::Level& level : finished.tree.levels) {
        EXPECT_TRUE(certify(*solid, level.elements.spheres()).holds);
    }
    EXPECT_EQ(finished.tree.levels[1].parents, (std::vector<std::uint32_t>{0, 0}));
    EXPECT_NEAR(finished.growth, finished.tree.finest()[0].radius - 0.5, 0.1) << "of the finest level only";
    EXPECT_LT(finished.growth, 0.5);
    const FinishedTree fitted = finished_tree(*solid, tree, Guarantee::fitted);
    EXPECT_EQ(fitted.tree.levels[0].elements.spheres(), tree.levels[0].elements.spheres()) << "neither grown nor shrunk";
    EXPECT_EQ(fitted.growth, 0);
}

TEST(FinishedTree, InnerLevelsKeepTheirParents) {
    const auto solid = Solid::make(test::box({0, 0, 0}, {4, 1, 1}));
    SphereTree tree; // of the middle level one sphere lies outside; its child goes to the nearest that is left
    tree.levels = {
        {{{{2, 0.5, 0.5}, 3}}, {}},
        {{{{2, 9, 9}, 0.1}, {{1, 0.5, 0.5}, 0.9}, {{3, 0.5, 0.5}, 0.9}}, {0, 0, 0}},
        {{{{0.7, 0.5, 0.5}, 0.4}, {{3.5, 0.5, 0.5}, 0.4}, {{1.5, 9, 9}, 0.1}, {{2.9, 0.4, 0.5}, 0.3}}, {1, 0, 1, 2}}};
    const SphereTree inner = finished_tree(*solid, tree, Guarantee::inner).tree;
    ASSERT_EQ(inner.levels.size(), 3u);
    ASSERT_EQ(inner.levels[1].elements.spheres().size(), 2u);
    EXPECT_EQ(inner.levels[1].parents, (std::vector<std::uint32_t>{0, 0}));
    ASSERT_EQ(inner.levels[2].elements.spheres().size(), 3u);
    EXPECT_EQ(inner.levels[2].parents, (std::vector<std::uint32_t>{0, 1, 1}));
    EXPECT_TRUE(inner.levels[0].parents.empty());
    for (const SphereTree::Level& level : inner.levels) {
        EXPECT_TRUE(certify_inner(*solid, level.elements.spheres()).holds);
    }
    tree.levels[1].elements.spheres() = {{{2, 9, 9}, 0.1}, {{2, 9, 9}, 0.1}, {{2, 9, 9}, 0.1}};
    const SphereTree bridged = finished_tree(*solid, tree, Guarantee::inner).tree;
    EXPECT_EQ(bridged.levels[1].elements.spheres(), (std::vector<Sphere>{bridged.levels[2].elements.spheres()[0]})) << "the largest below it";
    EXPECT_EQ(bridged.levels[1].parents, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(bridged.levels[2].parents, (std::vector<std::uint32_t>{0, 0, 0}));
    tree.levels[0].elements.spheres() = {{{2, 9, 9}, 0.1}};
    EXPECT_TRUE(finished_tree(*solid, tree, Guarantee::inner).tree.levels[0].parents.empty());
    EXPECT_EQ(finished_tree(*solid, tree, Guarantee::inner).tree.levels[0].elements.spheres().size(), 1u);
    tree.levels[2].elements.spheres().assign(4, {{2, 9, 9}, 0.1});
    EXPECT_THROW(finished_tree(*solid, tree, Guarantee::inner), Error);
    EXPECT_THROW(require_room(*solid, tree), Error);
    tree.levels[2].elements.spheres()[3] = {{2, 0.5, 0.5}, 0.1};
    EXPECT_NO_THROW(require_room(*solid, tree));
}

TEST(FinishedTree, OneSphereInsteadOfWorseOnes) {
    const auto solid = cube(1);
    const double least = volume(std::sqrt(0.75));
    const std::vector<Sphere> wide{{{-0.1, 0, 0}, 1}, {{0.1, 0, 0}, 1}}, good{{{}, std::sqrt(0.75) * (1 + 2.5e-5)}},
        worse{{{}, std::sqrt(0.75) * (1 + 5e-5)}};
    const FinishedTree one = finished_tree(*solid, flat_tree(wide), Guarantee::outer);
    EXPECT_TRUE(one.one_instead);
    ASSERT_EQ(one.tree.finest().size(), 1u);
    EXPECT_NEAR(one.tree.finest()[0].radius, std::sqrt(0.75), 2e-6);
    EXPECT_TRUE(certify(*solid, one.tree.finest()).holds);
    EXPECT_FALSE(finished_tree(*solid, flat_tree(wide), Guarantee::outer, false).one_instead);
    EXPECT_FALSE(finished_tree(*solid, flat_tree(wide), Guarantee::fitted).one_instead);
    EXPECT_FALSE(finished_tree(*solid, flat_tree(good), Guarantee::outer).one_instead) << "not clearly worse";
    EXPECT_TRUE(finished_tree(*solid, flat_tree(worse), Guarantee::outer).one_instead);
    // Many that overlap: their sum is large, what they take together is not.
    EXPECT_FALSE(finished_tree(*solid, flat_tree({good[0], good[0], good[0]}), Guarantee::outer).one_instead);
    EXPECT_NEAR(cost_volume(*solid, wide, Guarantee::outer), least - 1, 1e-6);
    EXPECT_NEAR(cost_volume(*solid, {{{}, 0.1}}, Guarantee::outer), least - 1, 1e-6) << "of what covers it";
    EXPECT_NEAR(cost_volume(*cube(0.5), wide, Guarantee::outer), (least - 1) / 8, 1e-6);
    EXPECT_NEAR(cost_volume(*solid, good, Guarantee::outer), volume(good[0].radius) - 1, 1e-9);
    EXPECT_NEAR(cost_volume(*solid, {{{}, 0.6}, {{5, 0, 0}, 0.5}}, Guarantee::inner), 1 - volume(0.5), 1e-9);
    EXPECT_NEAR(cost_volume(*solid, {{{0.1, 0, 0}, 0.6}, {{0.3, 0, 0}, 0.1}}, Guarantee::inner), 1 - volume(0.4), 1e-9);
    EXPECT_NEAR(cost_volume(*solid, {{{}, 0.5}}, Guarantee::fitted), 1 - volume(0.5), 3e-3) << "missing";
    EXPECT_NEAR(cost_volume(*solid, {{{}, 1}}, Guarantee::fitted), volume(1) - 1, 1e-9) << "excess";
    EXPECT_NEAR(cost_volume(*solid, {{{1, 0, 0}, 0.5}}, Guarantee::fitted), 1 + volume(0.5), 3e-3) << "both";
    EXPECT_NEAR(covered_protrusion(*solid, {{{}, 0.1}}, Guarantee::outer), std::sqrt(0.75) - 0.5, 1e-3);
    EXPECT_EQ(covered_protrusion(*solid, {{{}, 0.1}}, Guarantee::fitted), 0);
}

TEST(FinishedTree, NumbersInSinglePrecisionStillCoverOrFit) {
    Random random(6);
    const Vec3 place{50, -20, 10}; // where single precision moves a sphere by more than the grid does
    const auto solid = Solid::make(test::box(place - Vec3{0.5, 0.5, 0.5}, place + Vec3{0.5, 0.5, 0.5}));
    const auto single = [](double x) { return static_cast<double>(static_cast<float>(x)); };
    for (int round = 0; round < 8; ++round) {
        std::vector<Sphere> given = balls_in_cube(random, 1);
        for (Sphere& sphere : given) {
            sphere.center += place;
        }
        for (const Guarantee guarantee : {Guarantee::outer, Guarantee::inner, Guarantee::fitted}) {
            const auto plain = finished_tree(*solid, flat_tree(given), guarantee, false).tree.finest();
            const auto spheres = finished_tree(*solid, flat_tree(given), guarantee, false, Numbers::float32).tree.finest();
            ASSERT_EQ(spheres.size(), plain.size());
            std::vector<Sphere> read = spheres;
            for (std::size_t i = 0; i < read.size(); ++i) {
                const Vec3& c = read[i].center;
                read[i] = {{single(c.x), single(c.y), single(c.z)}, single(read[i].radius)};
                const double room = guarantee == Guarantee::fitted ? 0 : 0x1p-22 * 50.55;
                const double sign = guarantee == Guarantee::outer ? 1 : -1;
                EXPECT_NEAR(spheres[i].radius, plain[i].radius + sign * room, 2.1e-6 * (room > 0));
            }
            EXPECT_TRUE(guarantee != Guarantee::outer || certify(*solid, read).holds);
            EXPECT_TRUE(guarantee != Guarantee::inner || certify_inner(*solid, read).holds);
        }
    }
}

TEST(FinishedTree, ElementsOfOtherKindsAreFinishedBesideSpheres) {
    const auto solid = cube(1);
    const Element box{.kind = Element::Kind::box, .half = {0.5, 0.45678912345, 0.5}};
    SphereTree tree; // the sphere would be replaced by a better one if it were alone
    tree.levels = {{{{{}, 2}}}, {{{{{}, 0.1}, {{}, 2}}, {box}}, {0, 0}}};
    const FinishedTree outer = finished_tree(*solid, tree, Guarantee::outer);
    EXPECT_FALSE(outer.one_instead);
    ASSERT_EQ(outer.tree.levels.size(), 2u);
    EXPECT_NEAR(outer.tree.levels[1].elements.shaped()[0].half.y, 0.456790, 1e-12);
    EXPECT_NEAR(outer.growth, 0.456790 - 0.45678912345, 1e-12) << "of the finest level";
    EXPECT_EQ(outer.tree.levels[1].elements.spheres(), tree.levels[1].elements.spheres());
    tree.levels[1].elements.spheres().clear();
    tree.levels[1].parents = {0};
    const FinishedTree grown = finished_tree(*solid, tree, Guarantee::outer), fitted = finished_tree(*solid, tree, Guarantee::fitted);
    EXPECT_TRUE(covers(*solid, grown.tree.levels[1].elements));
    EXPECT_GE(grown.growth, 0.5 - 0.45678912345);
    EXPECT_LT(grown.growth, 0.044);
    EXPECT_NEAR(fitted.growth, 0.456790 - 0.45678912345, 1e-12);
}

TEST(FinishedTree, PaddedElementsGrowByALengthAndUpToTheGrid) {
    const Element box{.kind = Element::Kind::box, .half = {0.5, 0.4, 0.3}};
    SphereTree tree;
    tree.levels = {{{{{{0.1, 0, 0}, 0.2}}, {box}}}};
    const SphereTree wide = padded(*cube(1), tree, 0.0100004);
    EXPECT_NEAR(wide.levels[0].elements.spheres()[0].radius, 0.210001, 1e-12);
    EXPECT_EQ(wide.levels[0].elements.spheres()[0].center, tree.levels[0].elements.spheres()[0].center);
    EXPECT_NEAR(wide.levels[0].elements.shaped()[0].half.x, 0.510001, 1e-12);
    EXPECT_NEAR(wide.levels[0].elements.shaped()[0].half.z, 0.310001, 1e-12);
    const auto large = cube(1e8); // which has no grid
    const SphereTree beside = beside_kept(*large, tree);
    const double length = 1e-9 * large->bounds().diagonal();
    EXPECT_NEAR(length, 0.1732, 1e-4);
    EXPECT_NEAR(beside.levels[0].elements.spheres()[0].radius, 0.2 + length, 1e-12);
    EXPECT_NEAR(beside.levels[0].elements.shaped()[0].half.y, 0.4 + length, 1e-12);
}

TEST(FinishedTree, CostsOfElementsAreThoseOfWhatIsFinished) {
    const auto solid = cube(1);
    const auto costs = [&](const Element& e, Guarantee guarantee) {
        const Elements view(std::span(&e, 1));
        return std::pair{cost_of_elements(*solid, view, guarantee), protrusion_of_elements(*solid, view, guarantee)};
    };
    Element e{.kind = Element::Kind::box, .half = {0.6, 0.6, 0.6}};
    for (const Guarantee guarantee : {Guarantee::outer, Guarantee::fitted}) {
        const auto [volume, protrusion] = costs(e, guarantee);
        EXPECT_NEAR(volume, 1.2 * 1.2 * 1.2 - 1, 0.01);
        EXPECT_NEAR(protrusion, 0.1 * std::numbers::sqrt3, 0.03);
    }
    e.half = {0.5, 0.5, 0.5};
    EXPECT_NEAR(costs(e, Guarantee::outer).first, 0, 1e-3);
    e.pose.translation.x = 0.25;
    EXPECT_NEAR(costs(e, Guarantee::fitted).first, 0.25 + 0.25, 0.01) << "excess and missing";
    EXPECT_NEAR(costs(e, Guarantee::fitted).second, 0.25, 0.01);
    EXPECT_NEAR(costs(e, Guarantee::outer).first, 0.25, 0.01) << "it grows on the other side";
    const Element inside{.kind = Element::Kind::capsule, .half = {0, 0, 0.1}, .radius = 0.2};
    EXPECT_NEAR(costs(inside, Guarantee::fitted).first, 1 - volume(0.2) - std::numbers::pi * 0.04 * 0.2, 0.01);
    EXPECT_EQ(costs(inside, Guarantee::fitted).second, 0);
    EXPECT_GT(costs(inside, Guarantee::outer).first, volume(std::sqrt(0.5)) - 1) << "it has to reach the edges";
    EXPECT_GT(costs(inside, Guarantee::outer).second, std::sqrt(0.5) - 0.5);
    const std::vector<Sphere> spheres{{{0.1, 0, 0}, 0.6}};
    for (const Guarantee guarantee : {Guarantee::outer, Guarantee::inner, Guarantee::fitted}) {
        EXPECT_EQ(cost_of_elements(*solid, {spheres, {}}, guarantee), cost_volume(*solid, spheres, guarantee));
        EXPECT_EQ(protrusion_of_elements(*solid, {spheres, {}}, guarantee), covered_protrusion(*solid, spheres, guarantee));
    }
}

TEST(FinishedTree, ALevelThatIsGoneKeepsTheParentOfItsFirst) {
    const auto solid = cube(1);
    const Sphere outside{{9, 0, 0}, 0.1}, left{{-0.2, 0, 0}, 0.1}, right{{0.2, 0, 0}, 0.1};
    SphereTree tree;
    tree.levels = {{{{{}, 0.4}}, {}}, {{left, right}, {0, 0}}, {{outside, outside}, {1, 0}}, {{left, right}, {0, 1}}};
    const SphereTree inner = finished_tree(*solid, tree, Guarantee::inner).tree;
    EXPECT_EQ(inner.levels[2].parents, (std::vector<std::uint32_t>{1}));
    EXPECT_EQ(inner.levels[3].parents, (std::vector<std::uint32_t>{0, 0}));
}

TEST(FinishedTree, NoWrongVolumeIsBelowZero) {
    Random random(5);
    for (int round = 0; round < 100; ++round) {
        const double radius = random.uniform(0.1, 1);
        const auto solid = test::primitive_solid(Element::sphere(radius));
        for (const Guarantee guarantee : {Guarantee::outer, Guarantee::inner, Guarantee::fitted}) {
            EXPECT_GE(cost_volume(*solid, {{{}, radius}}, guarantee), 0);
        }
    }
}

} // namespace foam
