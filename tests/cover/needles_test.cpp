// Long thin solids of needles, far from the origin: covers as good as a row of equal balls, and growth that ends.
#include "geometry/shapes.hpp"

#include <foam/geometry/measure.hpp>
#include <foam/geometry/volumes.hpp>
#include <foam/search/spherize.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace foam::test {
namespace {

constexpr double length = 9000, radius = 1.5;

const Pose askew = Pose::from_xyz_rpy({}, {0.1, -0.4, 1.1});

/// A rod whose sides are triangles of any length up to the whole, as exports of swept surfaces have.
Mesh rod(const Vec3& begin) {
    constexpr std::uint32_t sides = 64, rings = 20;
    Mesh mesh;
    for (std::uint32_t r = 0; r <= rings; ++r) {
        const double along = length * std::pow(static_cast<double>(r) / rings, 4); // the last ones are long
        for (std::uint32_t k = 0; k < sides; ++k) {
            const double angle = 2 * std::numbers::pi * k / sides;
            const Vec3 aside{0, radius * std::cos(angle), radius * std::sin(angle)};
            mesh.vertices.push_back(begin + askew * (Vec3{along, 0, 0} + aside));
        }
    }
    const auto at = [](std::uint32_t r, std::uint32_t k) { return r * sides + k % sides; };
    for (std::uint32_t k = 0; k < sides; ++k) {
        for (std::uint32_t r = 0; r < rings; ++r) {
            mesh.triangles.push_back({at(r, k), at(r + 1, k), at(r + 1, k + 1)});
            mesh.triangles.push_back({at(r, k), at(r + 1, k + 1), at(r, k + 1)});
        }
    }
    for (std::uint32_t k = 1; k + 1 < sides; ++k) {
        mesh.triangles.push_back({at(0, 0), at(0, k), at(0, k + 1)});
        mesh.triangles.push_back({at(rings, 0), at(rings, k + 1), at(rings, k)});
    }
    return mesh;
}

double row_volume(std::size_t count) {
    const double r = length / 2 / static_cast<double>(count);
    return static_cast<double>(count) * 4 * std::numbers::pi / 3 * r * r * r;
}

TEST(Needles, CoversAreAsGoodAsARowOfEqualBalls) {
    const auto solid = Solid::make(rod({-20000, 12000, 5600}));
    for (const std::size_t count : {2, 4, 8, 16}) {
        for (const Effort effort : {Effort::fast, Effort::normal}) {
            const SphereCover cover = spherize(*solid, count, {.effort = effort});
            EXPECT_TRUE(cover.certificate.holds);
            EXPECT_LE(cover.volume, 1.1 * row_volume(count)) << count;
        }
    }
}

TEST(Needles, NeighboursShareAWideGap) {
    const Mesh mesh = rod({});
    const auto solid = Solid::make(mesh);
    const Vec3 along = askew * Vec3{length, 0, 0};
    std::vector<Sphere> spheres;
    for (const double share : {0.125, 0.375, 0.625, 0.875}) {
        spheres.push_back({share * along, length / 16});
    }
    const std::vector<Sphere> grown = grown_to_cover(*solid, spheres);
    EXPECT_TRUE(certify(*solid, grown).holds);
    for (const Sphere& sphere : grown) {
        EXPECT_LE(sphere.radius, 1.01 * length / 8);
    }
}

} // namespace
} // namespace foam::test
