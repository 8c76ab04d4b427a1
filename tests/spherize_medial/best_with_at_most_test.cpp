// Which of several numbers of spheres is taken.
#include "spherize_medial/best_with_at_most.hpp"

#include <foam/geometry/vector.hpp>

#include <gtest/gtest.h>

namespace foam::medial {
namespace {

/// Balls about the surface of the unit ball, along a spiral; the middle stays empty.
std::vector<Sphere> shell() {
    std::vector<Sphere> balls;
    for (const Vec3& direction : fibonacci_directions(200)) {
        balls.push_back({direction, 0.25});
    }
    return balls;
}

TEST(BestWithAtMost, AHollowInTheSolidIsNoGain) {
    const auto ball = Solid::make({{nullptr, Element::sphere(1), {}}});
    const std::vector<Sphere> around = shell();
    const Budget budget{around.size(), {}, Guarantee::outer};
    const auto trees = best_with_at_most(*ball, std::vector<Budget>{budget}, many_fewer, [&](auto budgets) {
        std::vector<SphereTree> made;
        for (const Budget& b : budgets) {
            made.push_back(flat_tree(*b.max_spheres < around.size() ? std::vector<Sphere>{{{}, 1.15}} : around));
        }
        return made;
    });
    EXPECT_EQ(trees.at(0).finest().size(), 1u) << "the shell's own volume is less, but it claims more outside";
}

} // namespace
} // namespace foam::medial
