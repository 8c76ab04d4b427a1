// Covers of which the best is known, by the objectives radius and protrusion: from meshes and from primitives.
#include "geometry/shapes.hpp"

#include <foam/search/spherize.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

constexpr double tolerance = 0.02;

double largest_radius(const SphereCover& cover) {
    double largest = 0;
    for (const Sphere& sphere : cover.spheres) {
        largest = std::max(largest, sphere.radius);
    }
    return largest;
}

std::shared_ptr<const Solid> solid_of(const Element& primitive) {
    return Solid::make(std::vector<Solid::Part>{{nullptr, primitive, Pose{}}});
}

/// The primitive and a mesh of it.
std::vector<std::pair<std::string, std::shared_ptr<const Solid>>> both_kinds(const Element& primitive) {
    const auto exact = solid_of(primitive);
    return {{"primitive", exact}, {"mesh", Solid::make(Mesh(exact->surface()))}};
}

Element box(const Vec3& size) {
    return Element::box(size);
}

void expect_radius(const Solid& solid, std::size_t count, double radius, Objective objective) {
    const SphereCover cover = spherize(solid, count, {.objective = objective});
    EXPECT_LE(cover.spheres.size(), count);
    EXPECT_TRUE(cover.certificate.holds);
    EXPECT_TRUE(certify(solid, cover.spheres).holds);
    EXPECT_NEAR(largest_radius(cover), radius, tolerance * radius) << count << " spheres";
}

TEST(KnownCovers, CubeByEqualBalls) {
    for (const auto& [kind, cube] : both_kinds(box({1, 1, 1}))) {
        SCOPED_TRACE(kind);
        expect_radius(*cube, 1, std::sqrt(3.0) / 2, Objective::radius);
        expect_radius(*cube, 2, 0.75, Objective::radius);
        expect_radius(*cube, 4, std::sqrt(1.5) / 2, Objective::radius);
        expect_radius(*cube, 8, std::sqrt(3.0) / 4, Objective::radius);
    }
}

TEST(KnownCovers, BallByOne) {
    const Element ball = Element::sphere(0.3);
    for (const auto& [kind, solid] : both_kinds(ball)) {
        SCOPED_TRACE(kind);
        expect_radius(*solid, 1, 0.3, Objective::radius);
        expect_radius(*solid, 1, 0.3, Objective::protrusion);
    }
}

TEST(KnownCovers, LongBoxByARow) {
    for (const auto& [kind, rod] : both_kinds(box({6, 1, 1}))) {
        SCOPED_TRACE(kind);
        for (const std::size_t count : {1, 3, 6}) {
            // Each holds a piece of the box of its own.
            expect_radius(*rod, count, std::hypot(6.0 / static_cast<double>(count), 1, 1) / 2, Objective::radius);
        }
    }
    // Balls about cubes stick out by as much at the ends as at the sides.
    expect_radius(*solid_of(box({6, 1, 1})), 6, std::sqrt(3.0) / 2, Objective::protrusion);
}

/// Equal balls along a capsule's segment, as far as the poles allow: where two meet, at half their distance h, they
/// reach its wall, and they stick out by e wherever the axis leads, r = R + e, h² = r² - R², L = 2 e + 2 h (count - 1).
double radius_of_row(double radius, double length, std::size_t count) {
    double low = 0, high = length / 2;
    for (int i = 0; i < 60; ++i) {
        const double e = (low + high) / 2, h = std::sqrt(e * (2 * radius + e));
        (2 * e + 2 * h * static_cast<double>(count - 1) < length ? low : high) = e;
    }
    return radius + high;
}

TEST(KnownCovers, CapsuleByARow) {
    const Element capsule = Element::capsule(0.1, 0.4);
    for (const auto& [kind, solid] : both_kinds(capsule)) {
        SCOPED_TRACE(kind);
        for (const std::size_t count : {1, 2, 4}) {
            const double known = radius_of_row(0.1, 0.4, count);
            expect_radius(*solid, count, known, Objective::radius);
            expect_radius(*solid, count, known, Objective::protrusion);
            const SphereCover cover = spherize(*solid, count, {.objective = Objective::protrusion});
            const Measures measures = measure(*solid, cover.spheres, {.surface_points = 100, .volume_rays = 100});
            EXPECT_NEAR(measures.protrusion_max, known - 0.1, tolerance * known);
        }
    }
}

} // namespace
