// The symmetric difference of balls and a solid.
#include "search/src/fitted/symmetric_difference.hpp"

#include <foam/runtime/contract.hpp>

#include <gtest/gtest.h>

namespace foam {
namespace {

TEST(SymmetricDifference, TheUseOfABallIsWhatIsLostWithoutIt) {
    const auto box = Solid::make(sample::box({0.3, 0.1, 0.1}));
    const by_spheres::Frame frame(box->bounds());
    const fitted::SymmetricDifference misfit(*box, frame, 48, 96, {});
    by_spheres::Balls balls;
    for (const Sphere& sphere : {Sphere{{-0.1, 0, 0}, 0.06}, Sphere{{0, 0, 0}, 0.07}, Sphere{{0.03, 0, 0}, 0.06},
                                 Sphere{{0, 0.12, 0}, 0.04}}) {
        balls.push_back(by_spheres::ball_of({frame.to_unit(sphere.center), sphere.radius / frame.unit}));
    }
    const std::vector<double> uses = misfit.uses(balls);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        by_spheres::Balls others = balls;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const double volume = 4.2 * balls[i].r * balls[i].r * balls[i].r;
        EXPECT_NEAR(uses[i], misfit.of(others) - misfit.of(balls), 0.05 * volume) << i;
    }
}

} // namespace
} // namespace foam
