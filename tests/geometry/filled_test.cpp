// Hollow geometry with its inside filled, and solids that are made in haste.
#include "geometry/shapes.hpp"

#include <foam/geometry/internal/solids.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

Solid::Part part_of(Mesh mesh) {
    return {std::make_shared<const Mesh>(std::move(mesh)), {}, {}};
}

/// The walls of a box of edge 1 about the origin; without the last: open at the top.
std::vector<Solid::Part> walls(double thickness, std::size_t count = 6) {
    std::vector<Solid::Part> parts;
    for (std::size_t i = 0; i < count; ++i) {
        const int axis = static_cast<int>(i / 2);
        Vec3 low{-0.5, -0.5, -0.5}, high{0.5, 0.5, 0.5};
        (i % 2 == 0 ? high : low)[axis] = i % 2 == 0 ? -0.5 + thickness : 0.5 - thickness;
        parts.push_back(part_of(box(low, high)));
    }
    return parts;
}

double filled_volume(const std::vector<Solid::Part>& parts) {
    const auto solid = Solid::make(parts);
    const auto full = filled(solid);
    return full == solid ? 0 : full->volume() - solid->volume();
}

TEST(Filled, WallsOfAnyThicknessEnclose) {
    for (const double thickness : {0.1, 0.02, 1e-3, 1e-5}) {
        const double inside = std::pow(1 - 2 * thickness, 3);
        EXPECT_GT(filled_volume(walls(thickness)), 0.8 * inside) << thickness;
        EXPECT_LT(filled_volume(walls(thickness)), inside) << thickness;
    }
}

TEST(Filled, TurnedThinWallsEnclose) {
    const Pose turned = Pose::from_xyz_rpy({0, 0, 0}, {0.4, 0.7, 1.1});
    std::vector<Solid::Part> parts = walls(1e-3);
    for (Solid::Part& part : parts) {
        part.mesh = std::make_shared<const Mesh>(transformed(*part.mesh, turned));
    }
    EXPECT_GT(filled_volume(parts), 0.7);
    EXPECT_LT(filled_volume(parts), 1);
}

/// The lines of the solid without its filling are not computed again: the figures are those of a solid made anew.
TEST(Filled, FiguresAreThoseOfTheSameParts) {
    std::vector<Solid::Part> parts = walls(0.05);
    for (Solid::Part& part : parts) {
        Mesh open = *part.mesh;
        open.triangles.pop_back();
        part = part_of(std::move(open));
    }
    const auto solid = Solid::make(parts);
    const auto full = filled(solid);
    ASSERT_NE(full, solid);
    const auto anew = Solid::make(full->parts());
    EXPECT_EQ(full->volume(), anew->volume());
    EXPECT_EQ(full->volume_error(), anew->volume_error());
    const std::vector<Sphere> spheres{{{0.1, 0, 0.1}, 0.3}};
    EXPECT_EQ(full->missing_volume(spheres), anew->missing_volume(spheres));
    EXPECT_GT(full->volume(), solid->volume());
}

TEST(Filled, AHoleInAWallDoesNotMatterAndABowlIsHalfFull) {
    std::vector<Solid::Part> open = walls(0.02, 5);
    const double bowl = filled_volume(open);
    open.push_back(part_of(box({-0.5, -0.5, 0.48}, {0.5, 0.3, 0.5})));
    const double slit = filled_volume(open);
    EXPECT_GT(slit, 0.7);
    EXPECT_LT(bowl, slit);
    EXPECT_GT(bowl, 0.3);
}

TEST(Filled, MeshesWithHoles) {
    Mesh shell = together(ball({}, 1), flipped(ball({}, 0.9)));
    shell.triangles.erase(shell.triangles.begin(), shell.triangles.begin() + 5);
    const auto solid = Solid::make(shell);
    ASSERT_FALSE(solid->closed());
    const auto full = filled(solid);
    EXPECT_TRUE(full->contains({}));
    EXPECT_TRUE(full->contains({0.5, 0.3, 0.2}));
    EXPECT_FALSE(full->contains({0.9, 0.9, 0}));
}

TEST(Filled, WhatIsFullOrFlatStays) {
    EXPECT_EQ(filled_volume({part_of(ball({}, 1))}), 0);
    EXPECT_EQ(filled_volume({part_of(torus(1, 0.3))}), 0);
    Mesh sheets = box({0, 0, 0}, {1, 1, 1});
    append(sheets, flipped(sheets));
    EXPECT_EQ(filled_volume({part_of(sheets)}), 0) << "a double-sided sheet has no inside";
    const auto point = Solid::make(Mesh{{{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {{0, 1, 2}}});
    EXPECT_EQ(filled(point), point);
}

TEST(QuickSolid, KnowsTheSameOnceItIsAsked) {
    const Mesh inside_out = flipped(ball({}, 1));
    const auto usual = Solid::make(inside_out), quick = quick_solid({part_of(inside_out)});
    EXPECT_EQ(quick->surface(), inside_out) << "as given";
    EXPECT_EQ(quick->bounds().low, usual->bounds().low);
    EXPECT_EQ(quick->area(), usual->area());
    EXPECT_TRUE(quick->contains({}));
    EXPECT_EQ(quick->signed_distance({0.1, 0.2, 0.3}), usual->signed_distance({0.1, 0.2, 0.3}));
    EXPECT_EQ(quick->closed(), usual->closed());
    EXPECT_EQ(quick->volume(), usual->volume());
}

TEST(QuickSolid, ProofsAndBoundsHold) {
    const Mesh mesh = torus(1, 0.3);
    const auto usual = Solid::make(mesh), quick = quick_solid({part_of(mesh)});
    const std::vector<Sphere> covering{{{}, 1.31}}, small{{{}, 1.2}};
    EXPECT_TRUE(certify(*quick, covering).holds);
    EXPECT_FALSE(certify(*quick, small).holds);
    EXPECT_EQ(certify(*quick, small).growth, certify(*usual, small).growth);
    const Measures bounds = bounds_of_measures(*quick, {covering, {}}), known = measure(*usual, covering);
    EXPECT_TRUE(bounds.certified);
    EXPECT_EQ(bounds.area, known.area);
    EXPECT_EQ(bounds.gap, 0);
    EXPECT_GE(bounds.excess_volume, known.excess_volume);
    EXPECT_GE(bounds.excess, known.excess);
    EXPECT_GE(bounds.protrusion_max, known.protrusion_max);
    EXPECT_GE(bounds.exposed_area, known.exposed_area);
    EXPECT_FALSE(bounds_of_measures(*quick, {small, {}}).certified);
}

} // namespace
