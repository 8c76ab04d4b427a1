// Geometry that is the image of other geometry, and the images of elements.
#include "shapes.hpp"

#include <foam/geometry/internal/likeness.hpp>

#include <gtest/gtest.h>

#include <random>

namespace foam {
namespace {

/// Returns a mesh without any symmetry, with two corners that are stored twice.
Mesh wedge() {
    Mesh mesh = test::torus(0.3, 0.1, 9);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.02, 0.02);
    for (Vec3& vertex : mesh.vertices) {
        vertex += {shift(random) + 0.4, shift(random), shift(random)};
    }
    mesh.vertices.push_back(mesh.vertices[0]);
    mesh.triangles[0] = {static_cast<std::uint32_t>(mesh.vertices.size() - 1), mesh.triangles[0][1],
                         mesh.triangles[0][2]};
    return mesh;
}

/// Returns the mesh as another file has it: in single precision, mirrored by y, the vertices in another order.
Mesh other_side(const Mesh& mesh) {
    Mesh result = mesh;
    std::reverse(result.vertices.begin(), result.vertices.end());
    for (Vec3& vertex : result.vertices) {
        vertex = {static_cast<float>(vertex.x), static_cast<float>(-vertex.y), static_cast<float>(vertex.z)};
    }
    const auto last = static_cast<std::uint32_t>(result.vertices.size() - 1);
    for (Triangle& triangle : result.triangles) {
        triangle = {last - triangle[0], last - triangle[2], last - triangle[1]};
    }
    std::reverse(result.triangles.begin(), result.triangles.end());
    return result;
}

Form form_of(const Mesh& mesh, const Pose& pose = {}) {
    return {{&mesh, {}, pose}};
}

Form form_of(const std::vector<Element>& primitives) {
    Form form;
    for (const Element& primitive : primitives) {
        form.push_back({nullptr, primitive, {}});
    }
    return form;
}

TEST(Likeness, AMirroredMesh) {
    const Mesh mesh = wedge(), other = other_side(mesh);
    const std::optional<Likeness> found = likeness(form_of(mesh), form_of(other));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->mirrored);
    for (const Vec3& vertex : mesh.vertices) {
        EXPECT_LT(distance(*found * vertex, {vertex.x, -vertex.y, vertex.z}), 1e-6);
    }
}

TEST(Likeness, ATurnedMesh) {
    const Mesh mesh = wedge();
    const Pose pose = Pose::from_xyz_rpy({0.1, 0.2, -3}, {0, 0, std::acos(-1.0) / 2});
    const std::optional<Likeness> found = likeness(form_of(mesh), form_of(mesh, pose));
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->mirrored);
    for (const Vec3& vertex : mesh.vertices) {
        EXPECT_LT(distance(*found * vertex, pose * vertex), 1e-6);
    }
}

TEST(Likeness, NotTheSame) {
    const Mesh mesh = wedge();
    Mesh moved = other_side(mesh);
    moved.vertices[3].z += 1e-5;
    EXPECT_FALSE(likeness(form_of(mesh), form_of(moved))) << "a vertex is elsewhere";
    Mesh joined = other_side(mesh);
    joined.triangles[4] = joined.triangles[5];
    EXPECT_FALSE(likeness(form_of(mesh), form_of(joined))) << "a triangle is missing";
    Mesh larger = mesh;
    for (Vec3& vertex : larger.vertices) {
        vertex *= 1.001;
    }
    EXPECT_FALSE(likeness(form_of(mesh), form_of(larger)));
    EXPECT_FALSE(likeness({}, {}));
    EXPECT_FALSE(likeness(form_of(mesh), {}));
}

TEST(Likeness, Primitives) {
    const auto at = [](Element element, const Vec3& xyz, const Vec3& rpy = {}) {
        return moved(std::move(element), Pose::from_xyz_rpy(xyz, rpy));
    };
    const std::vector<Element> left{at(Element::box({0.1, 0.2, 0.3}), {0.1, 0.2, 0}, {0.3, 0, 0}),
                                    at(Element::capsule(0.05, 0.2), {0, 0.3, 0.1}, {0.5, 0.2, 0})};
    const std::vector<Element> right{at(Element::box({0.1, 0.2, 0.3}), {0.1, -0.2, 0}, {-0.3, 0, 0}),
                                     at(Element::capsule(0.05, 0.2), {0, -0.3, 0.1}, {-0.5, 0.2, 0})};
    const std::optional<Likeness> found = likeness(form_of(left), form_of(right));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->mirrored);
    EXPECT_FALSE(likeness(form_of(left), form_of({right[0], at(Element::capsule(0.051, 0.2), {0, -0.3, 0.1})})));
    EXPECT_FALSE(likeness(form_of({Element::cylinder(0.05, 0.2)}), form_of({Element::capsule(0.05, 0.2)})));
    EXPECT_TRUE(likeness(form_of({Element::sphere(0.05)}), form_of({at(Element::sphere(0.05), {1, 2, 3})})));
}

/// Whether a point is in an element, and its image in the element's image.
TEST(Likeness, ImagesOfElements) {
    std::vector<Element> all{Element::sphere(0.3), Element::capsule(0.1, 0.4), Element::cylinder(0.2, 0.3),
                             Element::box({0.2, 0.3, 0.5}), Element::ellipsoid({0.1, 0.2, 0.3})};
    Element rounded = Element::box({0.2, 0.3, 0.5});
    rounded.kind = Element::Kind::swept_box;
    rounded.radius = 0.1;
    all.push_back(rounded);
    Element hull;
    hull.kind = Element::Kind::hull;
    hull.hull = convex_hull(wedge().vertices);
    all.push_back(hull);
    ASSERT_EQ(all.size(), element_kinds);
    const Likeness mirror{Pose::from_xyz_rpy({0.1, -0.2, 0.3}, {0.4, 0.5, 0.6}), true};
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-0.5, 0.5);
    for (Element& element : all) {
        element.pose = Pose::from_xyz_rpy({0.1, 0.2, 0.3}, {0.7, 0.8, 0.9}) * element.pose;
        const Element image = imaged(Elements(std::vector<Element>{element}), mirror)[0];
        EXPECT_TRUE(is_valid(image));
        EXPECT_NEAR(volume(image), volume(element), 1e-12);
        for (int i = 0; i < 200; ++i) {
            const Vec3 point{shift(random), shift(random), shift(random)};
            EXPECT_NEAR(signed_distance(element, point), signed_distance(image, mirror * point), 1e-12)
                << to_string(element.kind);
        }
    }
}

} // namespace
} // namespace foam
