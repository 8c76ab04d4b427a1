#include "search/src/cover/crease_points.hpp"

#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

namespace {

using namespace foam;

// Hundreds of spheres once began with balls of no size, and ended with the machine's memory.
TEST(CreasePoints, StayFewWhereTinyBallsLeaveNearlyAllOpen) {
    const auto box = Solid::make(sample::box({0.2, 0.2, 0.2}));
    const cover::Frame frame(box->bounds());
    const cover::Balls balls{{0, 0, 0, 1e-5f}, {0.1f, 0, 0, 1e-5f}};
    const cover::Points points = cover::crease_points(*box, frame, balls, 1e-5, 500);
    EXPECT_EQ(points.size(), 500u);
    double reach = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        reach = std::max(reach, points.at(i).z);
    }
    EXPECT_GT(reach, 0.55) << "they are to lie all over the surface";
}

} // namespace
