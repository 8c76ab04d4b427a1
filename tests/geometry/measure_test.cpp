// The figures of a model on cases whose answers are known.
#include "geometry/shapes.hpp"

#include <foam/base/parallel.hpp>
#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>

#include <gtest/gtest.h>

using namespace foam;
using namespace foam::test;

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

TEST(Measure, BallAroundACube) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const double radius = 1.8;
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, radius}});
    const double ball = 4 / 3.0 * pi * radius * radius * radius;
    EXPECT_EQ(m.spheres, 1u);
    EXPECT_TRUE(m.certified);
    EXPECT_EQ(m.gap, 0);
    EXPECT_EQ(m.covered, 1);
    EXPECT_DOUBLE_EQ(m.area, 24);
    EXPECT_DOUBLE_EQ(m.volume, 8);
    EXPECT_NEAR(m.excess, ball / 8 - 1, 1e-12) << "both volumes are known";
    EXPECT_NEAR(m.excess_volume, m.excess * 8, 1e-12);
    EXPECT_EQ(m.excess_error, 0);
    EXPECT_EQ(m.volume_error, 0);
    EXPECT_EQ(m.missing, 0);
    EXPECT_NEAR(m.exposed_area, 4 * pi * radius * radius, 1e-9);
    EXPECT_NEAR(m.protrusion_max, 0.8, 1e-6) << "above the faces' middles";
    EXPECT_GT(m.protrusion_mean, radius - std::sqrt(3.0));
    EXPECT_LT(m.protrusion_mean, 0.8);
}

TEST(Measure, BallInACube) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, 1}});
    EXPECT_FALSE(m.certified);
    EXPECT_NEAR(m.gap, std::sqrt(3.0) - 1, 2e-3);
    EXPECT_NEAR(m.covered, 0, 1e-4);
    EXPECT_NEAR(m.missing, 1 - pi / 6, 1e-12);
    EXPECT_NEAR(m.excess, 0, 1e-12);
    EXPECT_EQ(m.missing_error, 0);
    EXPECT_NEAR(m.protrusion_max, 0, 1e-12);
}

TEST(Measure, NoMoreThanAllIsMissing) {
    EXPECT_EQ(missing_share(1, 4), 0.25);
    EXPECT_EQ(missing_share(4.1, 4), 1) << "other lines than those of the volume";
    EXPECT_EQ(missing_share(1e-30, 0), 0) << "no volume, no share";
    Measures m;
    m.volume = 4;
    m.missing_volume = 4.1;
    EXPECT_EQ(total(std::array{m}).missing, 1);
}

TEST(Measure, CoveredShare) {
    // A ball about a corner covers a quarter disc on three faces.
    const auto cube = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    const Measures m = measure(*cube, std::vector<Sphere>{{{}, 0.5}});
    EXPECT_NEAR(m.covered, 3 * pi / 16 / 6, 2e-4);
    EXPECT_NEAR(m.missing, 1 - pi / 6 / 8, 1e-3);
    EXPECT_NEAR(m.excess, 7 * pi / 6 / 8, 2e-3);
    EXPECT_NEAR(m.gap, std::sqrt(3.0) - 0.5, 2e-3);
    EXPECT_NEAR(m.protrusion_max, 0.5, 1e-9);
}

namespace {

/// Balls on the faces of the cube [-1, 1]³, in rows and columns of eleven, that hold its surface and leave its middle
/// out.
std::vector<Sphere> shell_of_cube(double radius) {
    std::vector<Sphere> spheres;
    for (int i = -5; i <= 5; ++i) {
        for (int j = -5; j <= 5; ++j) {
            for (const double side : {-1.0, 1.0}) {
                const double a = i / 5.0, b = j / 5.0;
                spheres.insert(spheres.end(), {{{side, a, b}, radius}, {{a, side, b}, radius}, {{a, b, side}, radius}});
            }
        }
    }
    return spheres;
}

/// What balls of the cube hold of it, by points on a fine grid.
double share_of_cube(std::span<const Sphere> spheres) {
    constexpr int across = 60;
    int held = 0;
    for (int k = 0; k < across * across * across; ++k) {
        const auto at = [](int cell) { return (2 * cell + 1.0) / across - 1; };
        const Vec3 p{at(k % across), at(k / across % across), at(k / across / across)};
        held += std::any_of(spheres.begin(), spheres.end(),
                            [&](const Sphere& s) { return squared_norm(p - s.center) <= s.radius * s.radius; });
    }
    return static_cast<double>(held) / (across * across * across);
}

} // namespace

TEST(Measure, AHollowIsNoGain) {
    const auto cube = as_surface(*Solid::make(box({-1, -1, -1}, {1, 1, 1})));
    const std::vector<Sphere> shell = shell_of_cube(0.2);
    EXPECT_FALSE(measure(*Solid::make(box({-1, -1, -1}, {1, 1, 1})), shell).certified);
    const Measures hollow = measure(*cube, shell);
    EXPECT_TRUE(hollow.certified);
    EXPECT_GT(hollow.missing, 0.5);
    EXPECT_NEAR(hollow.missing, 1 - share_of_cube(shell), 3e-3);
    EXPECT_GT(hollow.missing_error, 0);
    EXPECT_LT(hollow.missing_error, 1e-3);
    std::vector<Sphere> full = shell;
    full.push_back({{}, 0.999}); // within the cube
    full.push_back({{}, 0.5});
    const Measures filled = measure(*cube, full);
    EXPECT_LT(filled.missing, 0.8 * hollow.missing);
    EXPECT_NEAR(filled.excess, hollow.excess, 4 * (filled.excess_error + hollow.excess_error));
    EXPECT_NEAR(cube->missing_volume(shell), hollow.missing_volume, 0.02);
    EXPECT_NEAR(geometry::joint_volume(*cube, shell), geometry::joint_volume(*cube, full), 0.03);
    EXPECT_NEAR(geometry::joint_volume(*cube, shell) - 8, hollow.excess_volume, 0.03);
}

TEST(Measure, WhatIsLeftOutIsTheSameEveryTime) {
    const auto solid = Solid::make(torus(1, 0.3, 24));
    EXPECT_NEAR(solid->missing_volume({}), solid->volume(), 3e-3 * solid->volume());
    const std::vector<Sphere> spheres{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.4}, {{0, 1, 0}, 0.45}};
    const double missing = solid->missing_volume(spheres);
    EXPECT_NEAR(missing, measure(*solid, spheres).missing_volume, 5e-3 * solid->volume());
    std::vector<double> again(8);
    parallel_for(again.size(), [&](std::size_t i) {
        again[i] =
            i % 2 == 0 ? solid->missing_volume(spheres) : Solid::make(torus(1, 0.3, 24))->missing_volume(spheres);
    });
    EXPECT_EQ(again, std::vector(8, missing));
    std::vector<Sphere> more = spheres;
    more.push_back({{0, 0, 0}, -3});
    more.push_back({{std::nan(""), 0, 0}, 3});
    more.push_back({{0, 0, 0}, std::numeric_limits<double>::infinity()});
    EXPECT_EQ(solid->missing_volume(more), missing) << "no spheres";
    more.push_back({{0, -1, 0}, 0.45});
    EXPECT_LT(solid->missing_volume(more), missing);
    EXPECT_EQ(solid->missing_volume(std::vector<Sphere>{{{}, 1.4}}), 0);
}

TEST(Measure, TheErrorIsHonest) {
    const auto solid = Solid::make(torus(1, 0.3, 24));
    const std::vector<Sphere> spheres{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.4}, {{0, 1, 0}, 0.45}};
    MeasureOptions fine;
    fine.volume_rays = 600'000;
    const double truth = measure(*solid, spheres, fine).excess;
    int within_two = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        MeasureOptions options;
        options.seed = seed;
        options.volume_rays = 1200;
        options.surface_points = 10;
        const Measures m = measure(*solid, spheres, options);
        within_two += std::abs(m.excess - truth) <= 2 * m.excess_error;
        EXPECT_LT(std::abs(m.excess - truth), 6 * m.excess_error);
    }
    EXPECT_GE(within_two, 15);
}

TEST(Measure, TheErrorOfAnOpenSolidIsHonest) {
    // Turned, the same solid meets other lines.
    Mesh mesh = torus(1, 0.3, 12);
    mesh.triangles.resize(mesh.triangles.size() * 9 / 10);
    const std::vector<Sphere> spheres{{{}, 1.8}};
    std::vector<double> volumes, errors;
    for (int turn = 1; turn <= 12; ++turn) {
        Mesh turned = mesh;
        const Pose pose = Pose::from_xyz_rpy({}, {0.3 * turn, 0.2 * turn, 0.1 * turn});
        for (Vec3& vertex : turned.vertices) {
            vertex = pose * vertex;
        }
        const Measures m = measure(*Solid::make(turned), spheres);
        EXPECT_GT(m.volume_error, 0);
        EXPECT_LT(m.volume_error, 5e-3 * m.volume);
        EXPECT_EQ(m.missing, 0);
        EXPECT_NEAR(m.excess_error, (1 + m.excess) * m.volume_error / m.volume, 1e-12);
        volumes.push_back(m.volume);
        errors.push_back(m.volume_error);
    }
    double mean = 0;
    for (const double volume : volumes) {
        mean += volume / static_cast<double>(volumes.size());
    }
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        EXPECT_NEAR(volumes[i], mean, 3 * errors[i]);
    }
}

TEST(Measure, LinesAndPointsAgree) {
    Mesh mesh = ball({}, 1, 16);
    const auto closed = Solid::make(mesh);
    mesh.triangles.pop_back();
    const auto open = Solid::make(mesh);
    const std::vector<Sphere> spheres{{{0.5, 0, 0}, 0.8}, {{-0.5, 0, 0}, 0.9}};
    const Measures a = measure(*closed, spheres), b = measure(*open, spheres);
    EXPECT_NEAR(a.excess, b.excess, 4 * b.excess_error + 2e-3);
    EXPECT_NEAR(a.missing, b.missing, 4 * b.missing_error + 2e-3);
    EXPECT_NEAR(a.protrusion_max, b.protrusion_max, 1e-3);
    EXPECT_NEAR(a.covered, b.covered, 2e-3);
}

TEST(Measure, NoSpheresAndNoVolume) {
    const auto cube = Solid::make(box({0, 0, 0}, {1, 1, 1}));
    const double infinity = std::numeric_limits<double>::infinity();
    const Measures none =
        measure(*cube, std::vector<Sphere>{{{}, 0}, {{std::nan(""), 0, 0}, 1}, {{}, -1}, {{}, infinity}, {{}, NAN}});
    EXPECT_EQ(none.spheres, 0u);
    EXPECT_EQ(none.covered, 0);
    EXPECT_NEAR(none.missing, 1, 1e-12);
    EXPECT_EQ(none.excess, 0);
    EXPECT_TRUE(std::isinf(none.gap));
    Mesh plane;
    plane.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    plane.triangles = {{0, 1, 2}};
    const Measures flat = measure(*Solid::make(plane), std::vector<Sphere>{{{0.5, 0.5, 0}, 1}});
    EXPECT_TRUE(flat.certified);
    EXPECT_EQ(flat.volume, 0);
    EXPECT_TRUE(std::isinf(flat.excess));
    EXPECT_EQ(flat.missing, 0);
    EXPECT_NEAR(flat.excess_volume, 4 / 3.0 * pi, 0.05);
}

TEST(Measure, AVolumeNextToNothing) {
    for (const double thin : {1e-178, 1e-310}) {
        const auto plate = Solid::make(box({-1, -1, 0}, {1, 1, thin}));
        const Measures m = measure(*plate, std::vector<Sphere>{{{}, 1.5}});
        EXPECT_GT(m.excess, 1e100);
        EXPECT_GE(m.excess_error, 0) << "a number";
        EXPECT_GE(m.missing_error, 0);
    }
}

TEST(Measure, SameSeedSameNumbers) {
    const auto solid = Solid::make(torus(1, 0.3, 12));
    const std::vector<Sphere> spheres{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.4}};
    MeasureOptions options;
    options.seed = 3;
    const Measures a = measure(*solid, spheres, options), b = measure(*solid, spheres, options);
    EXPECT_EQ(a.excess, b.excess);
    EXPECT_EQ(a.missing, b.missing);
    EXPECT_EQ(a.covered, b.covered);
    EXPECT_EQ(a.protrusion_mean, b.protrusion_mean);
    options.seed = 4;
    EXPECT_NE(a.excess, measure(*solid, spheres, options).excess);
}

TEST(Measure, Total) {
    Measures a, b;
    a.spheres = 2, a.area = 1, a.volume = 1, a.covered = 1, a.excess_volume = 0.5, a.certified = true;
    a.exposed_area = 1, a.protrusion_max = 0.1, a.protrusion_mean = 0.05, a.excess_volume_error = 0.03;
    b.spheres = 3, b.area = 3, b.volume = 3, b.covered = 0.9, b.excess_volume = 0.7, b.missing_volume = 0.4;
    b.gap = 0.01, b.exposed_area = 3, b.protrusion_max = 0.2, b.protrusion_mean = 0.01, b.excess_volume_error = 0.04;
    const Measures sum = total(std::vector<Measures>{a, b});
    EXPECT_EQ(sum.spheres, 5u);
    EXPECT_DOUBLE_EQ(sum.excess, 0.3);
    EXPECT_DOUBLE_EQ(sum.excess_error, 0.05 / 4);
    EXPECT_DOUBLE_EQ(sum.missing, 0.1);
    EXPECT_DOUBLE_EQ(sum.covered, 0.925);
    EXPECT_DOUBLE_EQ(sum.gap, 0.01);
    EXPECT_DOUBLE_EQ(sum.protrusion_max, 0.2);
    EXPECT_DOUBLE_EQ(sum.protrusion_mean, 0.02);
    EXPECT_FALSE(sum.certified);
    EXPECT_FALSE(total({}).certified);
}

TEST(Measure, BallHalfOutOfAFace) {
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vec3 center{};
            center[axis] = side;
            const Measures m = measure(*cube, std::vector<Sphere>{{center, 0.5}});
            EXPECT_NEAR(m.exposed_area, pi / 2, 5e-3);
            EXPECT_NEAR(m.protrusion_max, 0.5, 1e-6);
            EXPECT_NEAR(m.protrusion_mean, 0.25, 1e-3) << "Archimedes: the height is uniform over a sphere's area";
            EXPECT_NEAR(m.covered, pi / 96, 2e-4);
            EXPECT_NEAR(m.excess_volume, pi / 12, 4 * m.excess_volume_error);
            EXPECT_NEAR(m.missing_volume, 8 - pi / 12, 4 * m.missing_volume_error);
            EXPECT_GT(m.excess_volume_error, 1e-6);
            EXPECT_LT(m.excess_volume_error, 2e-4);
            EXPECT_DOUBLE_EQ(m.excess_error, m.excess_volume_error / 8);
            EXPECT_DOUBLE_EQ(m.missing_error, m.missing_volume_error / 8);
            EXPECT_DOUBLE_EQ(m.excess, m.excess_volume / 8);
        }
    }
}

TEST(Measure, HiddenSurfaceDoesNotProtrude) {
    // Of two balls on a face the second hides a cap of the first; one within another counts for nothing.
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    const std::vector<Sphere> one{{{1, 0, 0}, 0.5}}, within{{{1, 0, 0}, 0.5}, {{1.1, 0, 0}, 0.2}},
        twice{{{1, 0, 0}, 0.5}, {{1, 0, 0}, 0.5}};
    const geometry::Protrusion alone = geometry::protrusion(*cube, one, 20'000);
    EXPECT_NEAR(alone.exposed_area, pi / 2, 3e-4);
    EXPECT_EQ(geometry::protrusion(*cube, within, 20'000).exposed_area, alone.exposed_area);
    EXPECT_NEAR(geometry::protrusion(*cube, twice, 20'000).exposed_area, alone.exposed_area, 1e-9)
        << "one of them counts";
    // At a distance d of the centres a cap of height r - d/2 is hidden on each, half of it outside.
    const std::vector<Sphere> two{{{1, 0, 0}, 0.5}, {{1, 0.3, 0}, 0.5}};
    const geometry::Protrusion both = geometry::protrusion(*cube, two, 20'000);
    EXPECT_NEAR(both.exposed_area, pi - 2 * pi * 0.5 * 0.35, 1e-3);
    EXPECT_NEAR(both.max, 0.5, 1e-6);
    const std::vector<Sphere> apart{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.25}};
    const geometry::Protrusion sum = geometry::protrusion(*cube, apart, 20'000);
    EXPECT_NEAR(sum.exposed_area, pi / 2 + pi / 8, 1e-3);
    EXPECT_NEAR(sum.mean, (pi / 2 * 0.25 + pi / 8 * 0.125) / (pi / 2 + pi / 8), 1e-3) << "by area";
    EXPECT_NEAR(sum.max, 0.5, 1e-6);
    EXPECT_EQ(geometry::protrusion(*cube, std::vector<Sphere>{{{}, 0.5}}, 100).exposed_area, 0);
    EXPECT_EQ(geometry::protrusion(*cube, {}, 100).mean, 0);
    EXPECT_GT(geometry::protrusion(*cube, one, 0).exposed_area + 1, 0) << "at least one direction";
}

TEST(Measure, RefinementFindsTheFarthestPoint) {
    // A coarse set of directions: the search goes on to the point above the corner's diagonal.
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    for (const std::size_t directions : {20, 60}) {
        EXPECT_NEAR(geometry::protrusion(*cube, std::vector<Sphere>{{{1, 1, 1}, 0.5}}, directions).max, 0.5, 1e-3);
        EXPECT_NEAR(geometry::protrusion(*cube, std::vector<Sphere>{{{0.2, 0.1, 0}, 1.5}}, directions).max, 0.7, 1e-3);
    }
}

TEST(Measure, CoveredShareOfEachTriangle) {
    // Balls about faces' middles: what they hold of the surface are discs.
    const auto cube = Solid::make(box({-1, -1, -1}, {1, 1, 1}));
    MeasureOptions options;
    EXPECT_NEAR(geometry::covered_share(*cube, std::vector<Sphere>{{{1, 0, 0}, 0.9}, {{0, -1.1, 0}, 0.5}}, options),
                (0.81 + 0.24) * pi / 24, 3e-4);
    EXPECT_NEAR(geometry::covered_share(*cube, std::vector<Sphere>{{{}, 1.2}}, options), 6 * 0.44 * pi / 24, 3e-4);
    EXPECT_EQ(geometry::covered_share(*cube, std::vector<Sphere>{{{}, 1.8}}, options), 1);
    EXPECT_EQ(geometry::covered_share(*cube, {}, options), 0);
    options.surface_points = 0;
    EXPECT_EQ(geometry::covered_share(*cube, std::vector<Sphere>{{{}, 1.8}}, options), 0) << "nothing is known";
}

TEST(Measure, TotalOfErrorsAndNothing) {
    Measures a, b;
    a.volume = 2, a.excess_volume = 1, a.missing_volume = 0.5, a.area = 1, a.covered = 0.5, a.exposed_area = 2;
    a.volume_error = 0.03, a.excess_volume_error = 0.06, a.missing_volume_error = 0.02, a.protrusion_mean = 0.3,
    a.gap = 0.2;
    b.volume = 2, b.excess_volume = 3, b.missing_volume = 0.3, b.area = 4, b.covered = 0.25, b.exposed_area = 6;
    b.volume_error = 0.04, b.excess_volume_error = 0.08, b.missing_volume_error = 0.015, b.protrusion_mean = 0.1,
    b.gap = 0.1;
    a.protrusion_max = 0.7, b.protrusion_max = 0.6;
    for (const auto& links : {std::vector{a, b}, std::vector{b, a}}) {
        const Measures sum = total(links);
        EXPECT_DOUBLE_EQ(sum.volume, 4);
        EXPECT_DOUBLE_EQ(sum.area, 5);
        EXPECT_DOUBLE_EQ(sum.exposed_area, 8);
        EXPECT_DOUBLE_EQ(sum.gap, 0.2);
        EXPECT_DOUBLE_EQ(sum.protrusion_max, 0.7);
        EXPECT_DOUBLE_EQ(sum.volume_error, 0.05);
        EXPECT_DOUBLE_EQ(sum.excess_volume_error, 0.1);
        EXPECT_DOUBLE_EQ(sum.missing_volume_error, 0.025);
        EXPECT_DOUBLE_EQ(sum.covered, 1.5 / 5);
        EXPECT_DOUBLE_EQ(sum.protrusion_mean, 1.2 / 8);
        EXPECT_DOUBLE_EQ(sum.excess, 1);
        EXPECT_DOUBLE_EQ(sum.missing, 0.2);
        EXPECT_DOUBLE_EQ(sum.excess_error, std::sqrt(0.01 + 3 * 0.0025) / 4);
        EXPECT_DOUBLE_EQ(sum.missing_error, std::sqrt(0.000625 + 0.04 * 0.0025) / 4);
        EXPECT_FALSE(sum.certified);
    }
    Measures small;
    small.area = 0.25, small.covered = 0.5, small.exposed_area = 0.125, small.protrusion_mean = 0.3;
    EXPECT_DOUBLE_EQ(total(std::vector{small}).covered, 0.5);
    EXPECT_DOUBLE_EQ(total(std::vector{small}).protrusion_mean, 0.3);
    a.certified = true;
    EXPECT_TRUE(total(std::vector{a, a}).certified);
    EXPECT_FALSE(total(std::vector{a, b}).certified);
    EXPECT_FALSE(total(std::vector{b, a}).certified);
    a.volume = b.volume = 0;
    const Measures of_nothing = total(std::vector{a, b});
    EXPECT_EQ(of_nothing.missing, 0);
    EXPECT_EQ(of_nothing.missing_error, 0);
    EXPECT_EQ(of_nothing.excess, std::numeric_limits<double>::infinity());
    EXPECT_EQ(of_nothing.excess_error, 0);
    const Measures none = total(std::vector<Measures>{{}});
    EXPECT_EQ(none.covered, 0);
    EXPECT_EQ(none.protrusion_mean, 0);
    EXPECT_EQ(none.excess, 0);
    EXPECT_EQ(none.missing, 0);
}

namespace {

/// Balls about points of a brick's surface, in a grid: they cover it and leave its middle out.
std::vector<Sphere> shell_of_brick() {
    std::vector<Sphere> spheres;
    for (int x = -6; x <= 6; ++x) {
        for (int y = -4; y <= 4; ++y) {
            for (int z = -2; z <= 2; ++z) {
                if (std::abs(x) == 6 || std::abs(y) == 4 || std::abs(z) == 2) {
                    spheres.push_back({{x / 4.0, y / 4.0, z / 4.0}, 0.25});
                }
            }
        }
    }
    return spheres;
}

Mesh without_last(Mesh mesh, std::size_t count) {
    mesh.triangles.resize(mesh.triangles.size() - count);
    return mesh;
}

Mesh brick() {
    return box({-1.5, -1, -0.5}, {1.5, 1, 0.5});
}

std::vector<Sphere> shell_without_top() {
    std::vector<Sphere> spheres = shell_of_brick();
    std::erase_if(spheres, [](const Sphere& s) {
        return s.center.z == 0.5 && std::abs(s.center.x) < 1.2 && std::abs(s.center.y) < 0.8;
    });
    return spheres;
}

Mesh without_top(Mesh mesh) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return mesh.vertices[t[0]].z > 0 && mesh.vertices[t[1]].z > 0 && mesh.vertices[t[2]].z > 0;
    });
    return mesh;
}

const std::vector<Sphere> two_in_brick{{{0.3, 0.2, 0.1}, 0.7}, {{-1.4, -0.9, 0.3}, 0.4}};
const std::vector<Sphere> four_on_ring{{{1, 0, 0}, 0.5}, {{-1, 0, 0}, 0.6}, {{0, 1, 0}, 0.55}, {{0, -1, 0.1}, 0.6}};

struct Known {
    Mesh mesh;
    std::vector<Sphere> spheres;
    bool covered;
    std::size_t lines;
    double excess, excess_error, missing, missing_error;
};

} // namespace

TEST(FiguresStay, Volumes) {
    // Figures that were right, by every way to them: to ten digits.
    const Mesh cube = box({-1, -1, -1}, {1, 1, 1});
    std::vector<Sphere> around_corners; // they leave a little of the middle out
    for (int i = 0; i < 8; ++i) {
        around_corners.push_back({{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0}, std::sqrt(3.0) - 0.02});
    }
    const std::vector<Known> cases{
        {brick(), two_in_brick, false, 2800, 0.357059126461, 0.00479020577285, 4.65222151311, 0.00479020577285},
        {brick(), two_in_brick, false, 2950, 0.338806945206, 0.00507212413741, 4.63396933186, 0.00507212413741},
        {brick(), two_in_brick, false, 1, 0.513786632208, 0.165432429654, 4.80894901886, 0.165432429654},
        {torus(1, 0.3, 24), four_on_ring, false, 2800, 1.87113321543, 0.00409437250731, 0.577377867992,
         0.00409437250731},
        {brick(), shell_of_brick(), true, 2800, 6.17836409573, 0.0130880275413, 2.15767823032, 0.0130880275413},
        {without_last(brick(), 1), shell_of_brick(), true, 2800, 6.17839631701, 0.0130880599457, 2.15767823032,
         0.0130880275413},
        {without_last(brick(), 1), two_in_brick, false, 2800, 0.357059126461, 0.00479020577285, 4.65218929184,
         0.00479029430913},
        {without_last(torus(1, 0.3, 24), 2), four_on_ring, false, 2800, 1.87116349585, 0.00409448447707, 0.577377867992,
         0.00409437250731},
        {without_last(torus(1, 0.3, 24), 2), {{{}, 1.4}}, true, 2800, 9.75775983541, 3.02804289271e-05, 0, 0},
        {without_top(brick()), shell_without_top(), true, 2800, 5.400166636, 0.0140870411994, 2.89065273256,
         0.0140870411994},
        {cube, around_corners, true, 2800, 105.934232912, 9.35934921592e-05, 0.000171273305251, 9.35934921592e-05},
        {without_last(cube, 1), around_corners, true, 2800, 105.934210831, 8.02403237224e-05, 0, 0},
        {without_last(cube, 1),
         {{{}, std::sqrt(3.0) - 0.015}},
         false,
         2800,
         13.2051565266,
         8.23498180344e-05,
         1.85197996539e-05,
         1.85197996539e-05}};
    for (const Known& k : cases) {
        const auto whole = Solid::make(k.mesh), solid = k.covered ? as_surface(*whole) : whole;
        MeasureOptions options;
        options.seed = 1;
        options.volume_rays = k.lines;
        options.volume_points = 12 * k.lines;
        const geometry::Difference found = geometry::volume_difference(*solid, k.spheres, k.covered, options);
        const std::ptrdiff_t number = &k - cases.data();
        EXPECT_NEAR(found.excess.value, k.excess, 1e-10 * k.excess) << number;
        EXPECT_NEAR(found.excess.error, k.excess_error, 1e-10) << number;
        EXPECT_NEAR(found.missing.value, k.missing, 1e-10 * k.missing) << number;
        EXPECT_NEAR(found.missing.error, k.missing_error, 1e-10) << number;
    }
}

TEST(FiguresStay, Protrusions) {
    const auto solid = Solid::make(torus(1, 0.3, 24));
    const geometry::Protrusion found = geometry::protrusion(*solid, four_on_ring, 100);
    EXPECT_NEAR(found.exposed_area, 13.4494723093, 1e-9);
    EXPECT_NEAR(found.max, 0.401732226007, 1e-9);
    EXPECT_NEAR(found.mean, 0.194720812779, 1e-9);
    EXPECT_EQ(geometry::protrusion(*solid, four_on_ring, 0).exposed_area,
              geometry::protrusion(*solid, four_on_ring, 1).exposed_area);
}

TEST(Measure, TheUnitIsOfNoConcern) {
    // Powers of two change no digit.
    const auto of_size = [](const Mesh& mesh, std::vector<Sphere> spheres, double size) {
        for (Sphere& sphere : spheres) {
            sphere = {sphere.center * size, sphere.radius * size};
        }
        MeasureOptions options;
        options.volume_rays = 300;
        options.surface_points = 1'000;
        options.directions_per_sphere = 50;
        return measure(*Solid::make(transformed(mesh, {}, {size, size, size})), spheres, options);
    };
    for (const auto& [mesh, spheres] : {std::pair(brick(), two_in_brick), std::pair(torus(1, 0.3, 24), four_on_ring),
                                        std::pair(brick(), std::vector<Sphere>{{{}, 1.88}, {{1, 0, 0}, 0.3}})}) {
        const Measures one = of_size(mesh, spheres, 1);
        for (const double size : {std::ldexp(1.0, -24), std::ldexp(1.0, 24)}) {
            const Measures m = of_size(mesh, spheres, size);
            EXPECT_EQ(m.certified, one.certified);
            EXPECT_NEAR(m.excess, one.excess, 1e-7);
            EXPECT_NEAR(m.missing, one.missing, 1e-7);
            EXPECT_NEAR(m.excess_error, one.excess_error, 1e-7);
            EXPECT_NEAR(m.covered, one.covered, 1e-9);
            EXPECT_NEAR(m.protrusion_max / size, one.protrusion_max, 1e-7);
            EXPECT_NEAR(m.protrusion_mean / size, one.protrusion_mean, 1e-7);
            EXPECT_NEAR(m.exposed_area / size / size, one.exposed_area, 1e-7);
        }
    }
}

TEST(Measure, ABallAtTheTipOfALongTriangleCounts) {
    const Vec3 tip{10, 0, 0}, left{0, 0.1, 0}, right{0, -0.1, 0};
    MeasureOptions options;
    for (const auto& [a, b, c] :
         {std::tuple(tip, left, right), std::tuple(right, tip, left), std::tuple(left, right, tip)}) {
        const auto solid = Solid::make(Mesh{{a, b, c}, {{0, 1, 2}}});
        EXPECT_NEAR(geometry::covered_share(*solid, std::vector<Sphere>{{tip, 2}}, options), 0.04, 2e-3);
        EXPECT_NEAR(geometry::covered_share(*solid, std::vector<Sphere>{{tip, 9}}, options), 0.81, 2e-3);
        EXPECT_NEAR(geometry::covered_share(*solid, std::vector<Sphere>{{{-1, 0, 0}, 2}}, options), 0.19, 2e-3);
    }
}

TEST(Measure, WhereNoDirectionLeadsOnTheSearchEnds) {
    // The only direction points straight at the box.
    const auto ahead = Solid::make(box({1.5, -1, -1}, {3, 1, 1}));
    EXPECT_EQ(geometry::protrusion(*ahead, std::vector<Sphere>{{{}, 1}}, 1).max, 0.5);
}
