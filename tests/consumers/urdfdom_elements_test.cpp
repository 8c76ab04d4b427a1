// urdfdom on elements of write.urdf: kinds, sizes and poses.
#include "urdfdom_robot.hpp"

#include "write/elements.hpp"

#include <foam/geometry/element_forms.hpp>
#include <foam/geometry/vector.hpp>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const Robot> one_link() {
    return chain_of({"only"});
}

/// The element of a <collision> as urdfdom has it; hulls without their mesh.
Element element_of(const urdf::Collision& collision) {
    Element element{.pose = pose_of(collision.origin)};
    if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(collision.geometry.get())) {
        element.radius = sphere->radius;
    } else if (const auto* box = dynamic_cast<const urdf::Box*>(collision.geometry.get())) {
        element.kind = Kind::box;
        element.half = Vec3{box->dim.x, box->dim.y, box->dim.z} * 0.5;
    } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(collision.geometry.get())) {
        element.kind = Kind::cylinder;
        element.half.z = cylinder->length / 2;
        element.radius = cylinder->radius;
    } else {
        element.kind = Kind::hull;
        EXPECT_TRUE(dynamic_cast<const urdf::Mesh*>(collision.geometry.get()));
    }
    return element;
}

TEST(UrdfdomElements, HaveTheSameSizesAndPoses) {
    QuietContext context;
    const SphereModel model = model_of(one_link(), {group_of("only", {}, level_of({}, awkward_elements()))});
    const auto urdf = writer("write_urdf", "write.urdf"); // 3.0.1 knows no capsule
    const std::string text = urdf->write(model, context);
    const auto ours = urdf->read(text, urdf->files_beside(model, context)).at("only");
    const urdf::ModelInterfaceSharedPtr read = urdf::parseURDF(text);
    ASSERT_TRUE(read);
    std::vector<Element> stated;
    for (const urdf::CollisionSharedPtr& collision : read->getLink("only")->collision_array) {
        stated.push_back(element_of(*collision));
    }
    const Elements theirs = with_joined_capsules(stated);
    EXPECT_EQ(theirs.spheres(), ours.spheres());
    ASSERT_EQ(theirs.shaped().size(), ours.shaped().size());
    for (std::size_t i = 0; i < theirs.shaped().size(); ++i) {
        const Element &their = theirs.shaped()[i], &our = ours.shaped()[i];
        const double far = 1e-14 * (norm(our.pose.translation) + our.half.z); // their pose comes from a quaternion
        EXPECT_EQ(their.kind, our.kind);
        EXPECT_LE(distance(their.half, our.half), our.kind == Kind::capsule ? far : 0);
        EXPECT_NEAR(their.radius, our.radius, our.kind == Kind::capsule ? far : 0);
        EXPECT_EQ(their.pose.translation, our.pose.translation);
        for (std::size_t row = 0; row < 3; ++row) {
            EXPECT_LT(distance(their.pose.rotation[row], our.pose.rotation[row]), 2e-15);
        }
    }
}

TEST(UrdfdomElements, MeshesOfHullsAreNamedRelativeToTheFile) {
    QuietContext context;
    SphereModel model = model_of(one_link(), {group_of("only", {}, level_of({}, {tetrahedron({}, 1)}))});
    model.file = "my arm.urdf";
    const auto urdf = writer("write_urdf", "write.urdf");
    const urdf::ModelInterfaceSharedPtr read = urdf::parseURDF(urdf->write(model, context));
    ASSERT_TRUE(read);
    const auto* mesh = dynamic_cast<const urdf::Mesh*>(read->getLink("only")->collision->geometry.get());
    ASSERT_TRUE(mesh);
    EXPECT_EQ(mesh->filename, "my_arm_hulls/only_1.obj");
    EXPECT_EQ(urdf->files_beside(model, context).count(mesh->filename), 1U);
}

} // namespace
} // namespace foam::test
