// MuJoCo on elements of write.mjcf: kinds, sizes, poses, and that nothing of an element lies outside the geom.
#include "elements.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

#include <mujoco/mujoco.h>

#include <fstream>

namespace foam::test {
namespace {

struct Loaded {
    explicit Loaded(const std::string& text) {
        const TemporaryFolder folder; // cases run at once
        const std::string file = (folder.path() / "model.xml").string();
        std::ofstream(file) << text;
        char error[1000] = "";
        model = mj_loadXML(file.c_str(), nullptr, error, sizeof error);
        EXPECT_TRUE(model) << error;
    }
    ~Loaded() { mj_deleteModel(model); }
    mjModel* model = nullptr;
};

/// The element of a geom, in its body's frame.
Element element_of(const mjModel& model, int geom) {
    const mjtNum *size = model.geom_size + 3 * geom, *pos = model.geom_pos + 3 * geom;
    Element element;
    mjtNum m[9];
    mju_quat2Mat(m, model.geom_quat + 4 * geom);
    for (std::size_t row = 0; row < 3; ++row) {
        element.pose.rotation[row] = {m[3 * row], m[3 * row + 1], m[3 * row + 2]};
    }
    element.pose.translation = {pos[0], pos[1], pos[2]};
    switch (model.geom_type[geom]) {
    case mjGEOM_SPHERE:
        element.radius = size[0];
        break;
    case mjGEOM_CAPSULE:
    case mjGEOM_CYLINDER:
        element.kind = model.geom_type[geom] == mjGEOM_CAPSULE ? Kind::capsule : Kind::cylinder;
        element.radius = size[0];
        element.half.z = size[1];
        break;
    case mjGEOM_ELLIPSOID:
        element.kind = Kind::ellipsoid;
        element.half = {size[0], size[1], size[2]};
        break;
    case mjGEOM_BOX:
        element.kind = Kind::box;
        element.half = {size[0], size[1], size[2]};
        break;
    case mjGEOM_MESH: {
        const int mesh = model.geom_dataid[geom];
        std::vector<Vec3> corners;
        for (int v = 0; v < model.mesh_vertnum[mesh]; ++v) {
            const float* p = model.mesh_vert + 3 * (model.mesh_vertadr[mesh] + v);
            corners.push_back({p[0], p[1], p[2]});
        }
        element.kind = Kind::hull;
        element.hull = convex_hull(corners);
        break;
    }
    default:
        ADD_FAILURE() << "geom type " << model.geom_type[geom];
    }
    return element;
}

std::vector<Element> elements_of_body(const mjModel& model, const char* name) {
    std::vector<Element> elements;
    const int body = mj_name2id(&model, mjOBJ_BODY, name);
    for (int g = 0; g < model.ngeom; ++g) {
        if (model.geom_bodyid[g] == body) {
            elements.push_back(element_of(model, g));
        }
    }
    return elements;
}

TEST(MujocoElements, HaveTheSameSizesAndPoses) {
    QuietContext context;
    std::vector<Element> given = awkward_elements();
    const SphereModel model = model_of(turning("only"), {group_of("only", {}, level_of({}, given))});
    const auto mjcf = writer("xml_models", "write.mjcf");
    const std::string text = mjcf->write(model, context);
    const auto ours = mjcf->read(text, {}).at("only");
    const Loaded mujoco(text);
    ASSERT_TRUE(mujoco.model);
    std::vector<Element> theirs = elements_of_body(*mujoco.model, "only");
    ASSERT_EQ(theirs.size(), ours.spheres().size() + ours.shaped().size());
    theirs.erase(theirs.begin(), theirs.begin() + static_cast<std::ptrdiff_t>(ours.spheres().size()));
    for (std::size_t i = 0; i < theirs.size(); ++i) {
        ASSERT_EQ(theirs[i].kind, ours.shaped()[i].kind);
        if (theirs[i].kind == Kind::hull) { // MuJoCo moves a mesh to its centre, in single precision
            const double rounding =
                1e-6 * bounds(ours.shaped()[i]).diagonal() + 1e-15 * norm(ours.shaped()[i].pose.translation);
            for (const Vec3& p : ours.shaped()[i].hull->surface.vertices) {
                EXPECT_LE(distance(theirs[i], ours.shaped()[i].pose * p), rounding);
            }
            continue;
        }
        EXPECT_EQ(theirs[i].half, ours.shaped()[i].half);
        EXPECT_EQ(theirs[i].radius, ours.shaped()[i].radius);
        EXPECT_EQ(theirs[i].pose.translation, ours.shaped()[i].pose.translation);
        for (std::size_t row = 0; row < 3; ++row) {
            EXPECT_LT(distance(theirs[i].pose.rotation[row], ours.shaped()[i].pose.rotation[row]), 2e-15);
        }
    }
}

TEST(MujocoElements, ReadsGeomsOfOthersAsMujocoDoes) {
    const std::string text = R"(<mujoco><compiler angle="degree" eulerseq="XYZ"/>
      <default><default class="c"><geom type="capsule" size="0.1 0.3"/></default></default>
      <asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1" scale="1 2 -1"/></asset>
      <worldbody><body name="b"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><freejoint/>
        <geom class="c"/> <geom class="c" euler="10 20 30" pos="1 2 3"/>
        <geom type="capsule" fromto="0 0 0 1 2 -3" size="0.1"/> <geom type="cylinder" fromto="0 0 2 0 0 1" size="0.2"/>
        <geom type="box" size="1 2 3" axisangle="1 1 0 50"/> <geom type="box" size="1 2 3" xyaxes="0 2 0 -1 1 0"/>
        <geom type="cylinder" size="0.1 0.2" zaxis="1 1 1"/> <geom type="mesh" mesh="m" pos="0 0 1" quat="1 1 0 0"/>
        <geom type="ellipsoid" size="1 2 3"/> <geom type="box" fromto="0 0 0 1 2 -3" size="0.1"/>
        <geom type="box" fromto="1 0 1 1 0 2" size="0.3 7 8"/> <geom type="ellipsoid" fromto="0 1 0 1 2 3" size="0.2"/>
        <geom type="sphere" size="0.5"/> <geom type="capsule" size="1 1" contype="0" conaffinity="0"/>
      </body></worldbody></mujoco>)";
    Registry registry;
    registry.load(FOAM_TEST_PLUGINS "/xml_models.so");
    QuietContext context;
    const SphereFile read = registry.make<ModelReader>("read.mjcf")->read(text, "a.xml", context);
    ASSERT_EQ(read.links.size(), 1U);
    EXPECT_EQ(read.links[0].elements.spheres(), (std::vector<Sphere>{{{0, 0, 0}, 0.5}}));
    EXPECT_THAT(read.notes, testing::ElementsAre("1 geom is without contact and left out"));
    const Loaded mujoco(text);
    ASSERT_TRUE(mujoco.model);
    const std::vector<Element> theirs = elements_of_body(*mujoco.model, "b");
    const std::span<const Element> ours = read.links[0].elements.shaped();
    ASSERT_EQ(ours.size(), 12U);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        SCOPED_TRACE(i);
        ASSERT_EQ(ours[i].kind, theirs[i].kind);
        EXPECT_LT(distance(ours[i].half, theirs[i].half), 1e-15);
        EXPECT_EQ(ours[i].radius, theirs[i].radius);
        for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 2, 3}, Vec3{-1, 2, -3}}) {
            EXPECT_NEAR(dot(support(ours[i], d), d), dot(support(theirs[i], d), d),
                        ours[i].kind == Kind::hull ? 1e-6 : 1e-12);
        }
    }
}

} // namespace
} // namespace foam::test
