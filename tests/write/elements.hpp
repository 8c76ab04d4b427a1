// Elements of every kind for the tests of writers, and what must be true of what comes back.
#pragma once

#include "models.hpp"

#include <algorithm>
#include <foam/base/random.hpp>
#include <foam/sdk/elements.hpp>

#include <numbers>

namespace foam::test {

using Kind = Element::Kind;

inline Element capsule(const Pose& pose, double half, double radius) {
    return {.kind = Kind::capsule, .pose = pose, .half = {0, 0, half}, .radius = radius};
}
inline Element cylinder(const Pose& pose, double half, double radius) {
    return {.kind = Kind::cylinder, .pose = pose, .half = {0, 0, half}, .radius = radius};
}
inline Element box(const Pose& pose, const Vec3& half) {
    return {.kind = Kind::box, .pose = pose, .half = half};
}
inline Element swept_box(const Pose& pose, const Vec3& half, double radius) {
    return {.kind = Kind::swept_box, .pose = pose, .half = half, .radius = radius};
}
inline Element ellipsoid(const Pose& pose, const Vec3& radii) {
    return {.kind = Kind::ellipsoid, .pose = pose, .half = radii};
}
inline Element hull(const Pose& pose, const std::vector<Vec3>& points) {
    Element element{.kind = Kind::hull, .pose = pose};
    element.hull = convex_hull(points);
    return element;
}
inline Element tetrahedron(const Pose& pose, double size) {
    return hull(pose, {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}});
}

/// A rotation that needs all digits.
inline Pose awkward_pose() {
    return Pose::from_xyz_rpy({0.1, -0.2, 1.0 / 3}, {0.3, -1.1, 2.7});
}

/// One element of each kind but sphere, at an awkward pose.
inline std::vector<Element> one_of_each() {
    const Pose pose = awkward_pose();
    return {capsule(pose, 0.1 + 0.2, 0.1 + 0.7), cylinder(pose, 0.1 + 0.2, 1.0 / 3),
            box(pose, {0.1, 0.1 + 0.2, 1.0 / 3}), swept_box(pose, {0.1, 0.2, 1.0 / 7}, 0.05),
            tetrahedron(pose, 1.0 / 3), ellipsoid(pose, {0.1, 0.1 + 0.2, 1.0 / 7})};
}

/// Elements on which formats differ, or digits are lost.
inline std::vector<Element> awkward_elements() {
    std::vector<Element> elements = one_of_each();
    const double quarter = std::numbers::pi / 2;
    for (const Vec3& rpy : {Vec3{0, quarter, 0}, Vec3{0.4, -quarter, 0.3}, Vec3{quarter, 0, 0}, Vec3{0, 0, quarter},
                            Vec3{std::numbers::pi, 0, 0}, Vec3{0, std::numbers::pi, 1e-9}}) { // gimbal lock, half turns
        const Pose pose = Pose::from_xyz_rpy({1e-17, -3, 0.1}, rpy);
        elements.push_back(capsule(pose, 0.5, 0.125));
        elements.push_back(box(pose, {0.1, 0.2, 0.3}));
        elements.push_back(tetrahedron(pose, 0.3));
    }
    const Pose far = Pose::from_xyz_rpy({1e6, -1e6, 1.0 / 3}, {1, 1, 1});
    elements.push_back(capsule(far, 0.3, 0.1));
    elements.push_back(cylinder(far, 0.3, 0.1));
    elements.push_back(box(far, {0.1, 0.2, 0.3}));
    elements.push_back(swept_box(far, {0.1, 0.2, 0.3}, 0.1));
    elements.push_back(tetrahedron(far, 0.2));
    elements.push_back(ellipsoid(far, {0.1, 0.2, 0.3}));
    elements.push_back(capsule({}, 1e-9, 1e-9));
    elements.push_back(cylinder(awkward_pose(), 1e-9, 1e-9));
    elements.push_back(box({}, {1e-9, 1e-9, 1e-9}));
    elements.push_back(swept_box({}, {0, 0, 0.5}, 0.25)); // a capsule
    elements.push_back(capsule({}, 0, 0.25));             // a sphere
    Pose skew = awkward_pose();                           // orthonormal to 1e-7 only
    skew.rotation[0].x += 1e-7;
    elements.push_back(box(skew, {0.5, 0.25, 0.125}));
    elements.push_back(capsule(skew, 0.5, 0.25));
    return elements;
}

/// A level with spheres and these elements.
inline Approximation level_of(std::vector<Sphere> spheres, const std::vector<Element>& elements) {
    return flat_tree({std::move(spheres), elements});
}

/// Random points of the element: in it, and on its surface.
inline std::vector<Vec3> points_of(const Element& element, int count) {
    Random random(7);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const Vec3 d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
        const Vec3 a = support(element, d), b = support(element, {d.y, -d.z, d.x});
        points.push_back(a);
        points.push_back(a + (b - a) * random.uniform(0, 1));
    }
    return points;
}

/// Whether the elements hold the point, but for the rounding of a support point of an element of that reach.
inline bool covered(const Vec3& point, const Elements& elements, double allowed) {
    return std::any_of(elements.begin(), elements.end(),
                       [&](const Element& element) { return distance(element, point) <= allowed; });
}

/// Expects that what comes back contains the element, and is little larger. `larger`: share of its size.
inline void expect_contained(const Element& element, const Elements& back, double larger) {
    const Box own = bounds(element);
    // The certificate is what proves; here only the rounding of the sampled points is allowed.
    double skew = 0; // a rotation that is none, but nearly: support points and the body differ by so much
    for (std::size_t row = 0; row < 3; ++row) {
        skew = std::max(skew, std::abs(squared_norm(element.pose.rotation[row]) - 1));
    }
    const double allowed =
        1e-15 * (norm(element.pose.translation) + own.diagonal()) + (skew > 1e-12 ? 2 * skew * own.diagonal() : 0);
    for (const Vec3& point : points_of(element, 300)) {
        ASSERT_TRUE(covered(point, back, allowed)) << to_string(element.kind);
    }
    Box all;
    for (const Element& other : back) {
        all.add(bounds(other));
    }
    EXPECT_LE(all.diagonal(), own.diagonal() * (1 + larger) + 1e-8 * norm(element.pose.translation))
        << to_string(element.kind);
}

} // namespace foam::test
