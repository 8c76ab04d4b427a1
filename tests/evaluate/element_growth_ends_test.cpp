// Where the growth of elements ends: at the primitive, at the farthest corner, and at the one that adds least.
#include "tight_elements.hpp"

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

TEST(ElementGrowth, OfASmallerCopyEndsAtThePrimitive) {
    Random random(9);
    const std::vector<std::pair<Element, Element>> copies{
        {Element::sphere(0.3), {.kind = Kind::sphere, .radius = 0.3}},
        {Element::capsule(0.3, 1), {.kind = Kind::capsule, .half = {0, 0, 0.5}, .radius = 0.3}},
        {Element::cylinder(0.3, 1), {.kind = Kind::cylinder, .half = {0, 0, 0.5}, .radius = 0.3}},
        {Element::box({1, 2, 3}), {.kind = Kind::box, .half = {0.5, 1, 1.5}}}};
    for (const auto& [primitive, element] : copies) {
        for (const double smaller : {1e-3, 1e-6, 1e-9}) {
            const Pose pose = test::random_pose(random, 1);
            Element start = scaled(element, 1 - smaller);
            start.pose = pose;
            const auto solid = Solid::make({{nullptr, primitive, pose}});
            const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{start}))[0];
            // A cylinder grows to the facets around it, and of a capsule either the radius grows or the length.
            const double most = element.kind == Kind::cylinder  ? 2.5 * facet
                                : element.kind == Kind::capsule ? 4 * smaller + 1e-10
                                                                : 1e-10;
            EXPECT_LE(volume(grown), volume(element) * (1 + most)) << to_string(element.kind) << ' ' << smaller;
            EXPECT_GE(volume(grown), volume(element)) << to_string(element.kind) << ' ' << smaller;
        }
    }
}

TEST(ElementGrowth, OnlyTheElementThatAddsLeastGrows) {
    // A bar that sticks out of one of two boxes by a little.
    Element left{.kind = Kind::box, .half = {0.5, 0.2, 0.2}}, right = left;
    left.pose.translation = {-0.45, 0, 0};
    right.pose.translation = {0.45, 0, 0};
    const Mesh bar = test::box({-0.9, -0.1, -0.1}, {0.96, 0.1, 0.1});
    const Elements grown = grown_to_cover(*Solid::make(bar), Elements(std::vector{left, right}));
    EXPECT_NEAR(volume(grown[0]), volume(left), 1e-10);
    EXPECT_NEAR(volume(grown[1]), volume(right) * 1.01, 1e-10);
    EXPECT_NEAR(grown[1].half.y, 0.2, 1e-10);
}

TEST(ElementGrowth, OneEndGrowsWhereOneEndIsOpen) {
    // A bar along z that sticks out of one end.
    for (const double side : {-1.0, 1.0}) {
        const auto solid = Solid::make(test::box({-0.1, -0.1, side < 0 ? -1 : -0.4}, {0.1, 0.1, side < 0 ? 0.4 : 1}));
        const std::vector<std::pair<Element, double>> cases{
            // the end of the core, or of the element, that the corner at (0.1, 0.1, 1) asks for
            {{.kind = Kind::cylinder, .half = {0, 0, 0.45}, .radius = 0.3}, 1},
            {{.kind = Kind::box, .half = {0.3, 0.3, 0.45}}, 1},
            {{.kind = Kind::capsule, .half = {0, 0, 0.45}, .radius = 0.3}, 1 - std::sqrt(0.09 - 0.02)},
            {{.kind = Kind::swept_box, .half = {0.05, 0.05, 0.45}, .radius = 0.3}, 1 - std::sqrt(0.09 - 0.005)}};
        for (const auto& [element, end] : cases) {
            const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{element}))[0];
            EXPECT_NEAR(grown.half.z, (0.45 + end) / 2, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.pose.translation.z, side * (end - 0.45) / 2, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.radius, element.radius, 1e-9) << to_string(element.kind);
            EXPECT_NEAR(grown.half.x, element.half.x, 1e-9) << to_string(element.kind);
        }
    }
}

TEST(ElementGrowth, TheRadiusGrowsToTheFarthestCorner) {
    const auto solid = Solid::make(test::box({-0.3, -0.1, -0.1}, {0.2, 0.1, 0.1}));
    for (const auto& [element, radius] :
         {std::pair{Element{.kind = Kind::sphere, .radius = 0.2}, std::sqrt(0.09 + 0.02)},
          std::pair{Element{.kind = Kind::capsule, .half = {0, 0, 0.45}, .radius = 0.2}, std::sqrt(0.09 + 0.01)},
          std::pair{Element{.kind = Kind::cylinder, .half = {0, 0, 0.45}, .radius = 0.2}, std::sqrt(0.09 + 0.01)}}) {
        const Element grown = grown_to_cover(*solid, Elements(std::vector<Element>{element}))[0];
        EXPECT_NEAR(grown.radius, radius, 1e-9) << to_string(element.kind);
        EXPECT_NEAR(grown.half.z, element.half.z, 1e-9) << to_string(element.kind);
    }
}

} // namespace
