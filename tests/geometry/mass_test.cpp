// Volume, centre and inertia of solids against formulas.
#include "plain_shapes.hpp"

#include <foam/geometry/volumes.hpp>

#include <gtest/gtest.h>

namespace foam::test {
namespace {

constexpr double density = 1000;

std::shared_ptr<const Solid> solid_of(const Element& primitive, const Pose& pose = {}) {
    return Solid::make({{nullptr, primitive, pose}});
}

/// Returns the mass properties of a box about its own centre, turned by `pose`.
MassProperties of_box(const Vec3& size, const Pose& pose) {
    MassProperties mass;
    mass.mass = density * size.x * size.y * size.z;
    mass.center = pose.translation;
    const double x = size.x * size.x, y = size.y * size.y, z = size.z * size.z;
    const Vec3 diagonal = Vec3{y + z, x + z, x + y} * (mass.mass / 12);
    const auto entry = [&](int i, int j) { // (R I Rᵀ)ᵢⱼ
        const Vec3 &a = pose.rotation[static_cast<std::size_t>(i)], &b = pose.rotation[static_cast<std::size_t>(j)];
        return a.x * b.x * diagonal.x + a.y * b.y * diagonal.y + a.z * b.z * diagonal.z;
    };
    mass.inertia = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
    return mass;
}

/// Requires equal numbers up to `error`, relative to the largest of a kind.
void expect_near(const std::optional<MassProperties>& found, const MassProperties& expected, double error) {
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->mass, expected.mass, error * expected.mass);
    EXPECT_LT(distance(found->center, expected.center), error);
    const double largest = std::max({expected.inertia[0], expected.inertia[1], expected.inertia[2]});
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(found->inertia[i], expected.inertia[i], error * largest) << i;
    }
}

const Pose turned = Pose::from_xyz_rpy({3, -2, 7}, {0.3, -1.1, 2});
const Vec3 size{1, 2, 0.5};

TEST(Mass, OfABoxAsPrimitiveAndAsMesh) {
    const Element box = Element::box(size);
    expect_near(mass_properties(*solid_of(box, turned), density), of_box(size, turned), 1e-13);
    expect_near(mass_properties(*Solid::make(transformed(enclosing_mesh(box), turned)), density), of_box(size, turned),
                1e-13);
    expect_near(mass_properties(*Solid::make(flipped(transformed(enclosing_mesh(box), turned))), density),
                of_box(size, turned), 1e-13);
}

TEST(Mass, OfRoundPrimitivesAsFineMeshes) {
    for (const Element& primitive : {Element::sphere(0.3),
                                       Element::cylinder(0.3, 0.8),
                                       Element::capsule(0.3, 0.8)}) {
        const auto of_mesh =
            mass_properties(*Solid::make(transformed(enclosing_mesh(primitive, 400), turned)), density);
        ASSERT_TRUE(of_mesh);
        expect_near(mass_properties(*solid_of(primitive, turned), density), *of_mesh, 1e-3);
    }
    const auto ball = mass_properties(*solid_of(Element::sphere(0.5)), 2);
    ASSERT_TRUE(ball);
    EXPECT_DOUBLE_EQ(ball->mass, std::numbers::pi / 3);
    EXPECT_DOUBLE_EQ(ball->inertia[1], 0.4 * ball->mass * 0.25);
}

TEST(Mass, OfPartsIsThatOfTheirUnion) {
    const Element half = Element::box({1, 1, 1});
    const MassProperties whole = of_box({2, 1, 1}, {});
    const Pose left{Pose{}.rotation, {-0.5, 0, 0}}, right{Pose{}.rotation, {0.5, 0, 0}};
    expect_near(mass_properties(*Solid::make({{nullptr, half, left}, {nullptr, half, right}}), density), whole, 1e-9);
    const Element most = Element::box({1.5, 1, 1});
    const Pose more_left{Pose{}.rotation, {-0.25, 0, 0}}, more_right{Pose{}.rotation, {0.25, 0, 0}};
    expect_near(mass_properties(*Solid::make({{nullptr, most, more_left}, {nullptr, most, more_right}}), density),
                whole, 2e-2);
}

TEST(Mass, IsThatAboutTheCenterOfMass) {
    const auto at = [](double x, double length) {
        return Solid::Part{nullptr, Element::box({length, 1, 1}),
                           Pose{Pose{}.rotation, {x, 1, 0}}};
    };
    MassProperties expected;
    expected.mass = 3 * density;
    expected.center = {8.0 / 3, 1, 0};
    const double around = density * (64.0 / 9 + 2 * 16.0 / 9), across = density * (2 + 2 * 5) / 12;
    expected.inertia = {density * 3 * 2 / 12, across + around, across + around, 0, 0, 0};
    expect_near(mass_properties(*Solid::make({at(0, 1), at(4, 2)}), density), expected, 1e-12);
}

TEST(Mass, ACavityCountsAsEmpty) {
    const Mesh shell = together(box({-1, -1, -1}, {1, 1, 1}), flipped(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})));
    MassProperties expected = of_box({2, 2, 2}, {});
    const MassProperties inner = of_box({1, 1, 1}, {});
    expected.mass -= inner.mass;
    for (std::size_t i = 0; i < 6; ++i) {
        expected.inertia[i] -= inner.inertia[i];
    }
    expect_near(mass_properties(*Solid::make(shell), density), expected, 1e-9);
}

TEST(Mass, OfAMeshThatIsNotClosedIsThatInsideByItsWindingNumber) {
    Mesh open = box({-1, -1, -1}, {1, 1, 1});
    open.triangles.pop_back();
    const auto solid = Solid::make(open);
    ASSERT_FALSE(solid->closed());
    const auto found = mass_properties(*solid, density);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(found->mass, density * solid->volume());
    EXPECT_LT(norm(found->center), 0.2);
    EXPECT_GT(found->inertia[0], 0.5 * of_box({2, 2, 2}, {}).inertia[0]);
    EXPECT_LT(found->inertia[0], of_box({2, 2, 2}, {}).inertia[0]);
}

TEST(Mass, ThereIsNoneWithoutVolume) {
    EXPECT_FALSE(mass_properties(*Solid::make(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), density));
}

} // namespace
} // namespace foam::test
