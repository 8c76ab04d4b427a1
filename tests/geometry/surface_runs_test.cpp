// Runs of triangles that are close together, with a ball around each.
#include "geometry/shapes.hpp"

#include <foam/geometry/internal/solids.hpp>
#include <foam/geometry/internal/surface_runs.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

using namespace foam;
using namespace foam::geometry;
using namespace foam::test;

namespace {

constexpr std::size_t triangles_of_a_run = 16;

/// Checks what must hold for the runs of any surface without curved primitives.
void expect_runs_of(const Solid& solid) {
    const Mesh& surface = solid.surface();
    const SurfaceRuns& runs = surface_runs(solid);
    ASSERT_EQ(runs.size(), (surface.triangles.size() + triangles_of_a_run - 1) / triangles_of_a_run);
    const Vec3 origin = solid.bounds().center();
    std::vector<int> seen(surface.triangles.size(), 0);
    double extent = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        EXPECT_EQ(runs.triangles(r).size(),
                  std::min(triangles_of_a_run, surface.triangles.size() - r * triangles_of_a_run));
        for (const std::uint32_t t : runs.triangles(r)) {
            ++seen.at(t);
            for (const std::uint32_t corner : surface.triangles[t]) {
                const Vec3 p = surface.vertices[corner] - origin;
                EXPECT_LE(norm(p - runs[r].center), runs[r].radius * (1 + 1e-12)) << "run " << r;
                extent = std::max(extent, norm(p));
            }
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size())) << "each in one run";
    EXPECT_DOUBLE_EQ(runs.extent(), extent);
}

double mean_radius(const SurfaceRuns& runs) {
    double sum = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        sum += runs[r].radius;
    }
    return sum / static_cast<double>(runs.size());
}

/// A plane grid of n × m squares of edge 1 across two axes, each two triangles, in any order.
Mesh shuffled_grid(std::uint32_t n, std::uint32_t m, int first_axis, int second_axis, Random& random) {
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t k = 0; k <= m; ++k) {
            Vec3 p{7, 7, 7};
            p[first_axis] += i;
            p[second_axis] += k;
            mesh.vertices.push_back(p);
            if (i < n && k < m) {
                const std::uint32_t a = i * (m + 1) + k, b = a + m + 1;
                mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, b}, {b, a + 1, b + 1}});
            }
        }
    }
    for (std::size_t i = mesh.triangles.size(); i-- > 1;) {
        std::swap(mesh.triangles[i], mesh.triangles[random.below(i + 1)]);
    }
    return mesh;
}

} // namespace

TEST(SurfaceRuns, OfAGridAreBlocksOfFourTimesTwoSquares) {
    Random random(4);
    for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
        const auto solid = Solid::make(shuffled_grid(128, 128, a, b, random));
        const SurfaceRuns& runs = surface_runs(*solid);
        expect_runs_of(*solid);
        for (std::size_t r = 0; r < runs.size(); ++r) {
            EXPECT_NEAR(runs[r].radius, std::hypot(2, 1), 1e-12);
        }
        for (std::size_t g = 0; g < runs.group_count();
             ++g) { // 16 × 8 squares, to the corner of the run that is farthest
            EXPECT_NEAR(runs.group(g).radius, std::hypot(6, 3) + std::hypot(2, 1), 1e-12);
        }
    }
}

TEST(SurfaceRuns, TheLongestEdgeGivesTheScale) {
    Random random(5);
    for (const auto& [longest, other] : {std::pair{0, 1}, {1, 0}, {1, 2}, {2, 1}, {2, 0}, {0, 2}}) {
        const auto solid = Solid::make(shuffled_grid(128, 8, longest, other, random));
        const SurfaceRuns& runs = surface_runs(*solid);
        for (std::size_t r = 0; r < runs.size(); ++r) {
            EXPECT_NEAR(runs[r].radius, std::hypot(2, 1), 1e-12) << longest << other;
        }
    }
}

TEST(SurfaceRuns, AGroupIsABallAroundSixteenRuns) {
    for (const std::uint32_t n : {3u, 17u, 30u}) { // the last group has fewer
        const auto solid = Solid::make(ball({1, 2, 3}, 1, n));
        const SurfaceRuns& runs = surface_runs(*solid);
        ASSERT_EQ(runs.group_count(), (runs.size() + 15) / 16);
        for (std::size_t g = 0; g < runs.group_count(); ++g) {
            Box box;
            double radius = 0;
            for (std::size_t r = 16 * g; r < std::min(16 * g + 16, runs.size()); ++r) {
                box.add(runs[r].center);
                radius = std::max(radius, distance(runs[r].center, runs.group(g).center) + runs[r].radius);
            }
            EXPECT_EQ(runs.group(g).center, box.center());
            EXPECT_EQ(runs.group(g).radius, radius);
        }
    }
}

TEST(SurfaceRuns, AreOrderedInHasteAsTheyAreGiven) {
    const auto solid = quick_solid({{std::make_shared<const Mesh>(ball({}, 1, 6)), std::nullopt, {}}});
    const SurfaceRuns& runs = surface_runs(*solid);
    expect_runs_of(*solid);
    for (std::size_t r = 0; r < runs.size(); ++r) {
        for (std::size_t k = 0; k < runs.triangles(r).size(); ++k) {
            EXPECT_EQ(runs.triangles(r)[k], 16 * r + k);
        }
    }
}

TEST(SurfaceRuns, HaveEachTriangleOnceInABallThatContainsIt) {
    Random random(3);
    for (const double away : {0.0, 1e3, -1e7}) {
        Mesh mesh = ball({away, 0, 1}, 1, 30);
        for (std::size_t i = mesh.triangles.size(); i-- > 1;) { // a file has them in any order
            std::swap(mesh.triangles[i], mesh.triangles[random.below(i + 1)]);
        }
        const auto solid = Solid::make(mesh);
        expect_runs_of(*solid);
        // 16 triangles that are close together: a patch of some times their size, whatever their order in the file.
        const double edge = std::sqrt(4 * std::numbers::pi / static_cast<double>(mesh.triangles.size()));
        EXPECT_LT(mean_radius(surface_runs(*solid)), 6 * edge);
    }
}

TEST(SurfaceRuns, OfSurfacesWithoutAnExtent) {
    const Mesh point{{{1, 2, 3}}, std::vector<Triangle>(40, Triangle{0, 0, 0})};
    const Mesh line{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, std::vector<Triangle>(17, Triangle{0, 1, 2})};
    const Mesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    for (const Mesh& mesh : {point, line, one}) {
        expect_runs_of(*Solid::make(mesh));
    }
    EXPECT_EQ(surface_runs(*Solid::make(point))[0].radius, 0);
}

TEST(SurfaceRuns, OfTinyAndHugeOnes) {
    for (const double size : {1e-9, 1e8}) {
        Mesh mesh = ball({}, 1, 12);
        for (Vec3& v : mesh.vertices) {
            v = v * size;
        }
        const auto solid = Solid::make(mesh);
        expect_runs_of(*solid);
        EXPECT_LT(mean_radius(surface_runs(*solid)), 0.8 * size);
    }
}

TEST(SurfaceRuns, ABallContainsNoneOfACurvedPrimitive) {
    // The triangles of a sphere or cylinder lie inside of it: what contains them may not contain the primitive.
    const Element cylinder = Element::cylinder(0.1, 1), block = Element::box({1, 1, 1});
    const auto infinite = [](const Element& primitive) {
        const auto solid = Solid::make(
            std::vector<Solid::Part>{{std::make_shared<const Mesh>(enclosing_mesh(primitive)), primitive, {}}});
        const SurfaceRuns& runs = surface_runs(*solid);
        std::size_t count = 0;
        for (std::size_t r = 0; r < runs.size(); ++r) {
            count += std::isinf(runs[r].radius) ? 1 : 0;
        }
        return std::pair(count, runs.size());
    };
    EXPECT_EQ(infinite(cylinder).first, infinite(cylinder).second);
    EXPECT_EQ(infinite(block).first, 0u);
}

TEST(SurfaceRuns, OnlyBallsWithATriangleOfACurvedPrimitiveAreInfinite) {
    // Far apart: a cylinder between two meshes, of which one comes before it and one after it.
    Pose middle;
    middle.translation = {50, 0, 0};
    const auto left = std::make_shared<const Mesh>(ball({}, 1, 12)),
               right = std::make_shared<const Mesh>(ball({99, 0, 0}, 1, 12));
    const auto solid = Solid::make({{left, std::nullopt, {}},
                                    {nullptr, Element::cylinder(1, 1), middle},
                                    {right, std::nullopt, {}}});
    const std::span<const std::uint32_t> offsets = solid->part_offsets();
    const SurfaceRuns& runs = surface_runs(*solid);
    std::size_t finite = 0;
    for (std::size_t r = 0; r < runs.size(); ++r) {
        const auto triangles = runs.triangles(r);
        const bool curved = std::any_of(triangles.begin(), triangles.end(),
                                        [&](std::uint32_t t) { return t >= offsets[1] && t < offsets[2]; });
        EXPECT_EQ(std::isinf(runs[r].radius), curved) << r;
        finite += !curved;
    }
    EXPECT_GT(finite, 10u);
    EXPECT_LT(finite, runs.size());
}

TEST(SurfaceRuns, AreMadeOnceByManyThreads) {
    const auto solid = Solid::make(ball({}, 1, 40));
    std::vector<const SurfaceRuns*> seen(8);
    {
        std::vector<std::jthread> threads;
        for (const SurfaceRuns*& one : seen) {
            threads.emplace_back([&] { one = &surface_runs(*solid); });
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), seen.front()), 8);
    expect_runs_of(*solid);
}
