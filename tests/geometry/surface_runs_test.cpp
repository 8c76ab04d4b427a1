// Runs of triangles that are close together, with a ball around each.
#include "geometry/shapes.hpp"

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

} // namespace

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
    const Primitive cylinder{Primitive::Kind::cylinder, {}, 0.1, 1}, block{Primitive::Kind::box, {1, 1, 1}, 0, 0};
    const auto infinite = [](const Primitive& primitive) {
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
