// The proof of a least element against its definition: a tree of cells, each halved until its bound is near the least.
#include "convex/random_points.hpp"
#include "search/src/convex/least_fit.hpp"

#include <foam/search/least_element.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace foam {
namespace {

using namespace search::convex;
using Kind = Element::Kind;

/// The bound of a cell, and the least element along the orientation in its middle.
std::pair<double, Fit> bound_of(Kind kind, const Cloud& cloud, const Orientations& cell) {
    const double angle = reach(cell, kind != Kind::box);
    if (kind == Kind::box) {
        const std::array<Vec3, 3> axes = axes_at(cell.at);
        return {bound_of_box(cloud, axes, angle), box_along(cloud, axes)};
    }
    if (kind == Kind::cylinder) {
        const Fit here = cylinder_along(cloud, direction_at(cell));
        return {bound_of_cylinder(cloud, here, angle), here};
    }
    const Fit here = descended(capsule_along(cloud, direction_at(cell)), cloud, 60, 0.1, true);
    return {bound_of_capsule(volume(here), angle), here};
}

/// All cells below some, halved where their bound is below a volume.
struct CellTree {
    Kind kind;
    const Cloud& cloud;
    double halved_below;
    std::size_t cells = 0;
    double least_bound = std::numeric_limits<double>::infinity(); ///< of those that are not halved
    double least_found = std::numeric_limits<double>::infinity();

    void add_all() {
        for (const Orientations& cell : all_orientations(kind != Kind::box)) {
            add(cell);
        }
    }
    void add(const Orientations& cell) {
        ++cells;
        const auto [bound, here] = bound_of(kind, cloud, cell);
        least_found = std::min(least_found, volume(here));
        if (bound < halved_below) {
            for (const Orientations& part : parts_of(cell, kind != Kind::box)) {
                add(part);
            }
        } else {
            least_bound = std::min(least_bound, bound);
        }
    }
};

TEST(ProvedLeast, HalvesTheCellsWhoseBoundsAreBelowTheTolerance) {
    std::size_t compared = 0;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
        for (const auto& [kind, tolerance] : {std::pair{Kind::box, 0.07}, {Kind::cylinder, 0.05}, {Kind::capsule, 0.2}}) {
            const std::vector<Vec3> points = test::random_points(8, seed, Vec3{1, 0.6, 0.3} * (seed % 2 ? 0.02 : 30),
                                                                 Pose::from_xyz_rpy({1, 2, 3}, {3, 2, 1}));
            const Cloud cloud = cloud_of(points);
            const Fit best = least_fit(kind, cloud, Effort::best);
            CellTree tree{kind, cloud, volume(best) / (1 + tolerance)};
            tree.add_all();
            if (tree.least_found < volume(best)) {
                continue; // which cells are taken then depends on when it is found
            }
            ++compared;
            const ProvedElement proved = proved_least(kind, points, tolerance);
            EXPECT_EQ(proved.element, element_of(best, cloud));
            EXPECT_EQ(proved.volume, volume(proved.element));
            EXPECT_EQ(proved.cells, tree.cells) << to_string(kind) << seed;
            EXPECT_DOUBLE_EQ(proved.lower_bound, tree.least_bound * std::pow(cloud.unit, 3)) << to_string(kind) << seed;
            EXPECT_LE(proved.volume, proved.lower_bound * (1 + tolerance) * (1 + 1e-6));
        }
    }
    EXPECT_GT(compared, 12u);
}

TEST(ProvedLeast, TakesTheLeastOfAllThatItSees) {
    constexpr double tolerance = 0.1;
    std::size_t better = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        for (const Kind kind : {Kind::box, Kind::cylinder}) {
            const std::vector<Vec3> points = test::random_points(5, seed, {1, 0.8, 0.6});
            const Cloud cloud = cloud_of(points);
            const double cube = std::pow(cloud.unit, 3);
            const ProvedElement proved = proved_least(kind, points, tolerance);
            CellTree tree{kind, cloud, proved.volume / cube / (1 + tolerance) * (1 - 1e-9)};
            tree.add_all(); // no more than were looked at
            EXPECT_GE(proved.cells, tree.cells);
            EXPECT_LE(proved.volume, tree.least_found * cube * (1 + 1e-6));
            EXPECT_LE(proved.lower_bound, tree.least_found * cube);
            EXPECT_LE(proved.volume, proved.lower_bound * (1 + tolerance) * (1 + 1e-6));
            for (const Vec3& p : points) {
                EXPECT_TRUE(holds(proved.element, p));
            }
            better += proved.volume < volume(least_fit(kind, cloud, Effort::best)) * cube * (1 - 1e-5);
        }
    }
    EXPECT_GT(better, 0u) << "else this test says little";
}

} // namespace
} // namespace foam
