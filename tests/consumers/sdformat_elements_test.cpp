// sdformat on elements of write.sdf: kinds, sizes and poses.
#include "write/elements.hpp"

#include <sdf/sdf.hh>

#include <gmock/gmock.h>

namespace foam::test {
namespace {

Vec3 vector_of(const ignition::math::Vector3d& v) {
    return {v.X(), v.Y(), v.Z()};
}

Element element_of(const sdf::Collision& collision) {
    const ignition::math::Pose3d& pose = collision.RawPose();
    const ignition::math::Matrix3d m(pose.Rot());
    Element element;
    for (unsigned row = 0; row < 3; ++row) {
        element.pose.rotation[row] = {m(row, 0), m(row, 1), m(row, 2)};
    }
    element.pose.translation = vector_of(pose.Pos());
    const sdf::Geometry& geometry = *collision.Geom();
    if (const sdf::Box* box = geometry.BoxShape()) {
        element.kind = Kind::box;
        element.half = vector_of(box->Size()) * 0.5;
    } else if (const sdf::Capsule* capsule = geometry.CapsuleShape()) {
        element.kind = Kind::capsule;
        element.half.z = capsule->Length() / 2;
        element.radius = capsule->Radius();
    } else if (const sdf::Cylinder* cylinder = geometry.CylinderShape()) {
        element.kind = Kind::cylinder;
        element.half.z = cylinder->Length() / 2;
        element.radius = cylinder->Radius();
    } else if (const sdf::Ellipsoid* ellipsoid = geometry.EllipsoidShape()) {
        element.kind = Kind::ellipsoid;
        element.half = vector_of(ellipsoid->Radii());
    } else if (const sdf::Sphere* sphere = geometry.SphereShape()) {
        element.radius = sphere->Radius();
    } else {
        element.kind = Kind::hull;
        EXPECT_TRUE(geometry.MeshShape());
    }
    return element;
}

TEST(SdformatElements, HaveTheSameSizesAndPoses) {
    QuietContext context;
    const SphereModel model = model_of(chain_of({"only"}), {group_of("only", {}, level_of({}, awkward_elements()))});
    const auto writes = writer("write_sdf", "write.sdf");
    const std::string text = writes->write(model, context);
    const auto ours = writes->read(text, writes->files_beside(model, context)).at("only");
    sdf::Root root;
    for (const sdf::Error& error : root.LoadSdfString(text)) {
        ADD_FAILURE() << error.Message();
    }
    ASSERT_TRUE(root.Model());
    const sdf::Link& link = *root.Model()->LinkByName("only");
    std::vector<Element> theirs;
    std::vector<Sphere> spheres;
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
        const Element element = element_of(*link.CollisionByIndex(i));
        if (element.kind == Kind::sphere) {
            spheres.push_back({element.pose.translation, element.radius});
        } else {
            theirs.push_back(element);
        }
    }
    EXPECT_EQ(spheres, ours.spheres());
    ASSERT_EQ(theirs.size(), ours.shaped().size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
        EXPECT_EQ(theirs[i].kind, ours.shaped()[i].kind);
        EXPECT_EQ(theirs[i].half, ours.shaped()[i].half);
        EXPECT_EQ(theirs[i].radius, ours.shaped()[i].radius);
        EXPECT_EQ(theirs[i].pose.translation, ours.shaped()[i].pose.translation);
        for (std::size_t row = 0; row < 3; ++row) {
            EXPECT_LT(distance(theirs[i].pose.rotation[row], ours.shaped()[i].pose.rotation[row]), 2e-15);
        }
    }
}

} // namespace
} // namespace foam::test
