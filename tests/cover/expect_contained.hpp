// Balls that contain a skin.
#pragma once

#include "search/src/by_spheres/measured/surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace foam::test {

inline void expect_contained(const by_spheres::FineSurface& skin, const by_spheres::Balls& balls) {
    const by_spheres::Points& points = skin.points;
    for (std::size_t p = 0; p < points.size(); ++p) {
        ASSERT_TRUE(std::ranges::any_of(balls,
                                        [&](const by_spheres::Ball& ball) {
                                            return std::sqrt(ball.squared_distance(
                                                       points.x[p], points.y[p], points.z[p])) <= ball.r * (1 + 1e-5f);
                                        }))
            << "point " << p << " of " << balls.size() << " balls";
    }
}

} // namespace foam::test
