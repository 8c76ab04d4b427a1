// Few spheres in a slab and in round parts, to be grown.
#pragma once

#include "geometry/plain_shapes.hpp"

#include <foam/geometry/solid.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace foam::test {

/// Covers that were right stay as they are: radii of some of them, to nine digits.
inline void expect_radii(const std::vector<Sphere>& spheres, const std::vector<double>& radii) {
    ASSERT_EQ(spheres.size(), radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
        EXPECT_NEAR(spheres[i].radius, radii[i], 2e-9 * (1 + radii[i])) << "sphere " << i;
    }
}

inline const std::shared_ptr<const Solid> slab = Solid::make(box({-1, -0.7, -0.2}, {1, 0.7, 0.2}));

inline std::vector<Sphere> six_in_slab() {
    Random random(21);
    std::vector<Sphere> spheres;
    for (int i = 0; i < 6; ++i) {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-0.2, 0.2);
        spheres.push_back({{x, y, z}, random.uniform(0.1, 0.4)});
    }
    return spheres;
}

/// Five rows of four, more than needed.
inline std::vector<Sphere> twenty_over_slab() {
    std::vector<Sphere> spheres;
    for (int i = 0; i < 5; ++i) {
        for (int j = 0; j < 4; ++j) {
            spheres.push_back({{-0.8 + 0.4 * i, -0.525 + 0.35 * j, 0.01 * i}, 0.42});
        }
    }
    spheres[3].radius = 0.5;
    spheres[13].radius = 0.7;
    return spheres;
}

inline std::shared_ptr<const Solid> round_parts() {
    return Solid::make({{nullptr, Element::capsule(0.1, 0.4), Pose{}},
                        {nullptr, Element::cylinder(0.15, 0.3), Pose::from_xyz_rpy({0.2, 0, 0}, {0, 1, 0})}});
}

inline const std::vector<Sphere> four_in_round_parts{
    {{0, 0, 0.2}, 0.1}, {{0, 0, -0.15}, 0.08}, {{0.15, 0.02, 0}, 0.1}, {{0.3, 0, 0.05}, 0.12}};

} // namespace foam::test
