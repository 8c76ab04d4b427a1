// Meshes of MJCF: files and vertices, where they stand, hulls, and primitives that are fitted to them.
#include "loading.hpp"

#include <foam/base/text.hpp>

#include <algorithm>

namespace foam::test {
namespace {

/// The tetrahedron as vertices of the text.
const std::string corners = "vertex='0 0 0 1 0 0 0 2 0 0 0 3'";

const GeometryElement& first(const Robot& robot) {
    return link_of(robot, "world").collisions.at(0);
}

const MeshReference& mesh_of(const Robot& robot) {
    return std::get<MeshReference>(first(robot).geometry);
}

/// The farthest corners of the only geom, in the world.
Box box_of(const Robot& robot) {
    Box box;
    for (const Vec3& v : mesh_of(robot).mesh->vertices) {
        box.add(first(robot).origin * v);
    }
    return box;
}

Robot with_mesh(const std::string& mesh, const std::string& geom = "type='mesh'", const std::string& compiler = "") {
    return load_world("<geom mesh='m' " + geom + "/>", compiler + "<asset><mesh name='m' " + mesh + "/></asset>");
}

TEST(LoadMjcfMeshes, AMeshOfTheTextCollidesAsItsHull) {
    const Robot robot = with_mesh("vertex='0 0 0  1 0 0  0 2 0  0 0 3  .1 .1 .1'", "type='mesh' pos='1 1 1'");
    EXPECT_TRUE(mesh_of(robot).path.empty());
    EXPECT_EQ(mesh_of(robot).mesh->vertices.size(), 4u);
    expect_at(box_of(robot).low, {1, 1, 1});
    expect_at(box_of(robot).high, {2, 3, 4});
}

TEST(LoadMjcfMeshes, FirstMovesThenTurnsThenScales) {
    const Robot robot = with_mesh(corners + " refpos='1 0 0' refquat='1 0 0 1' scale='1 10 -1'");
    expect_at(box_of(robot).low, {0, 0, -3}); // (x, y, z) - refpos, turned back by 90 degrees about z, scaled
    expect_at(box_of(robot).high, {2, 10, 0});
    EXPECT_GT(signed_volume(*mesh_of(robot).mesh), 0);
    EXPECT_EQ(mesh_of(robot).scale, (Vec3{1, 1, 1}));
    EXPECT_EQ(mesh_of(robot).uri, ""); // no file has this mesh
}

TEST(LoadMjcfMeshes, FilesAreFoundByNameAndFolder) {
    const TemporaryFolder folder;
    write(folder.path() / "meshes" / "t.obj", tetrahedron_obj);
    QuietContext context;
    for (const char* text : {
             "<mujoco><compiler meshdir='meshes'/><asset><mesh file='t.obj'/></asset>",
             "<mujoco><compiler assetdir='meshes' strippath='true'/><asset><mesh file='../other/t.obj'/></asset>",
             "<mujoco><asset><mesh file='meshes/t.obj'/></asset>",
             "<mujoco><compiler assetdir='none'/><compiler meshdir='meshes'/><asset><mesh name='t' "
             "file='t.obj'/></asset>",
         }) {
        const Robot robot =
            load_mjcf(std::string(text) + "<worldbody><geom type='mesh' mesh='t'/></worldbody></mujoco>", context,
                      folder.path() / "robot.xml");
        EXPECT_EQ(mesh_of(robot).path, (folder.path() / "meshes" / "t.obj").lexically_normal()) << text;
        expect_at(box_of(robot).high, {1, 2, 3});
    }
}

TEST(LoadMjcfMeshes, TheTrianglesAreTakenWhereTheyAreWanted) {
    const TemporaryFolder folder;
    write(folder.path() / "t.obj", tetrahedron_obj);
    const auto mesh = [&](const std::string& type, const std::string& semantics) {
        QuietContext context;
        return mesh_of(load_mjcf("<mujoco><asset><mesh file='t.obj' scale='2 2 2'/></asset><worldbody><geom type='" +
                                     type + "' mesh='t'/></worldbody></mujoco>",
                                 context, folder.path() / "robot.xml", {{"semantics", semantics}}));
    };
    EXPECT_NE(mesh("mesh", "mujoco").mesh, nullptr);
    EXPECT_EQ(mesh("mesh", "mujoco").scale, (Vec3{2, 2, 2}));
    EXPECT_EQ(mesh("mesh", "raw").mesh, nullptr);
    EXPECT_EQ(mesh("mesh", "raw").scale, (Vec3{2, 2, 2}));
    EXPECT_EQ(mesh("sdf", "mujoco").mesh, nullptr);
}

TEST(LoadMjcfMeshes, ReadsMshFiles) {
    const TemporaryFolder folder;
    const std::int32_t counts[] = {4, 0, 0, 1}, triangle[] = {0, 1, 2};
    const float vertices[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
    std::string bytes(reinterpret_cast<const char*>(counts), sizeof counts);
    bytes.append(reinterpret_cast<const char*>(vertices), sizeof vertices);
    bytes.append(reinterpret_cast<const char*>(triangle), sizeof triangle);
    write(folder.path() / "t.msh", bytes);
    QuietContext context;
    const Robot robot = load_mjcf(
        "<mujoco><asset><mesh file='t.msh'/></asset><worldbody><geom type='mesh' mesh='t'/></worldbody></mujoco>",
        context, folder.path() / "robot.xml");
    expect_at(box_of(robot).high, {1, 2, 3});
}

TEST(LoadMjcfMeshes, KeepsEveryVertexInSinglePrecision) {
    std::string vertices;
    for (int i = 0; i < 19; ++i) { // not a multiple of what a processor takes at once
        vertices += number_text(0.223485 + 0.01 * i) + " " + number_text(0.011841 * i * i) + " " +
                    number_text(0.0013 * i * i * i) + " ";
    }
    const Robot robot = with_mesh("vertex='" + vertices + "'");
    ASSERT_EQ(mesh_of(robot).mesh->vertices.size(), 19u);
    for (const Vec3& v : mesh_of(robot).mesh->vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            const volatile float single = static_cast<float>(v[axis]);
            EXPECT_EQ(single, v[axis]);
        }
    }
}

/// A box of 2 x 4 x 6 about (1, 2, 3), whose triangles stand in the text.
const std::string box_mesh = "vertex='0 0 0 2 0 0 0 4 0 2 4 0 0 0 6 2 0 6 0 4 6 2 4 6' "
                             "face='0 2 1 1 2 3 4 5 6 5 7 6 0 1 4 1 5 4 2 6 3 3 6 7 0 4 2 2 4 6 1 3 5 3 7 5'";

TEST(LoadMjcfMeshes, FitsByInertia) {
    const auto fitted = [](const char* geom) { return std::get<Element>(first(with_mesh(box_mesh, geom)).geometry); };
    const Element box = fitted("type='box'");
    EXPECT_NEAR(box.half.x, 1, 1e-12); // ascending, as MuJoCo turns its axes
    EXPECT_NEAR(box.half.y, 2, 1e-12);
    EXPECT_NEAR(box.half.z, 3, 1e-12);
    EXPECT_NEAR(fitted("").radius, 2, 1e-12); // without a type it is a sphere
    const Element capsule = fitted("type='capsule' fitscale='2'");
    EXPECT_NEAR(capsule.radius, 3, 1e-12);
    EXPECT_NEAR(capsule.half.z, 2 * 2.25, 1e-12);
    expect_at(first(with_mesh(box_mesh, "type='box' pos='1 0 0'")).origin * Vec3{}, {2, 2, 3});
}

TEST(LoadMjcfMeshes, FitsByTheBoxAlongItsAxes) {
    const Robot robot = with_mesh(box_mesh, "type='cylinder'", "<compiler fitaabb='true'/>");
    const Element cylinder = std::get<Element>(first(robot).geometry);
    EXPECT_NEAR(cylinder.radius, 2, 1e-12);
    EXPECT_NEAR(cylinder.half.z, 3, 1e-12);
    expect_at(first(robot).origin * Vec3{}, {1, 2, 3});
}

TEST(LoadMjcfMeshes, AnythingSeenMayLackItsFile) {
    ListeningContext context;
    const Robot robot =
        load_mjcf("<mujoco><asset><mesh file='t.obj'/></asset><worldbody><geom type='mesh' mesh='t' contype='0' "
                  "conaffinity='0'/></worldbody></mujoco>",
                  context);
    EXPECT_TRUE(link_of(robot, "world").visuals.empty());
    EXPECT_EQ(context.messages.at(0), "/none/robot.xml:1: its mesh is not found; the geom is left out of pictures");
}

} // namespace
} // namespace foam::test
