// What load.sdf reads besides poses, what it refuses, and what write.sdf makes of its text.
#include "loading.hpp"

#include <sdf/sdf.hh>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>

namespace foam::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

std::string error_of(const std::string& text, const std::filesystem::path& file = "/none/robot.sdf") {
    try {
        QuietContext context;
        load_sdf(text, context, file);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "no error";
}

std::string shaped(const std::string& shape) {
    return model("\n<link name='l'><collision name='c'><geometry>" + shape + "</geometry></collision></link>");
}

Geometry shape_of(const std::string& shape) {
    return load_sdf(shaped(shape)).links.at(0).collisions.at(0).geometry;
}

TEST(LoadSdf, ReadsEveryShape) {
    using Kind = Element::Kind;
    const auto element = [](const std::string& shape) { return std::get<Element>(shape_of(shape)); };
    EXPECT_EQ(element("<box><size>1 2 3</size></box>").half, (Vec3{0.5, 1, 1.5}));
    EXPECT_EQ(element("<sphere><radius>2</radius></sphere>").radius, 2);
    const Element cylinder = element("<cylinder><radius>1</radius><length>4</length></cylinder>");
    EXPECT_EQ(cylinder.kind, Kind::cylinder);
    EXPECT_EQ(cylinder.half.z, 2);
    const Element capsule = element("<capsule><radius>1</radius><length>4</length></capsule>");
    EXPECT_EQ(capsule.kind, Kind::capsule);
    EXPECT_EQ(capsule.half.z, 2);
    EXPECT_EQ(element("<ellipsoid><radii>1 2 3</radii></ellipsoid>").half, (Vec3{1, 2, 3}));
}

TEST(LoadSdf, ExtrudesPolylines) {
    // An L of 3 m²; clockwise, and closed by its first point.
    const auto mesh = std::get<MeshReference>(shape_of(
        "<polyline><point>0 0</point><point>0 2</point><point>1 2</point><point>1 1</point><point>2 1</point>"
        "<point>2 0</point><point>0 0</point><height>0.5</height></polyline>"));
    ASSERT_TRUE(mesh.mesh);
    EXPECT_TRUE(topology(*mesh.mesh).closed_manifold());
    EXPECT_NEAR(signed_volume(*mesh.mesh), 1.5, 1e-12);
    EXPECT_EQ(bounds(*mesh.mesh).low.z, 0);
    EXPECT_EQ(bounds(*mesh.mesh).high.z, 0.5);
    EXPECT_THAT(error_of(shaped("<polyline><point>0 0</point><point>1 1</point><height>1</height></polyline>")),
                HasSubstr("/none/robot.sdf:2: <polyline> has no area"));
}

TEST(LoadSdf, ReadsConesOfLaterVersions) {
    const auto mesh = std::get<MeshReference>(shape_of("<cone><radius>1</radius><length>3</length></cone>"));
    ASSERT_TRUE(mesh.mesh);
    const double volume = std::numbers::pi; // of the cone, which the mesh holds
    EXPECT_GT(signed_volume(*mesh.mesh), volume);
    EXPECT_LT(signed_volume(*mesh.mesh), 1.005 * volume);
    EXPECT_EQ(bounds(*mesh.mesh).low.z, -1.5);
    EXPECT_EQ(bounds(*mesh.mesh).high.z, 1.5);
    EXPECT_THAT(error_of(shaped("<cone><radius>0</radius><length>3</length></cone>")),
                HasSubstr("the radius of <cone> is 0"));
}

TEST(LoadSdf, RefusesShapesThatItDoesNotKnow) {
    EXPECT_THAT(error_of(shaped("<torus><radius>1</radius></torus>")),
                HasSubstr("/none/robot.sdf:2: foam knows no shape <torus>; remedy: another shape, or a mesh"));
    EXPECT_TRUE(load_sdf(shaped("<empty/>")).links.at(0).collisions.empty());
}

TEST(LoadSdf, MeshesCollideAsTheirHullWhereTheFileSaysSo) {
    const TemporaryFolder folder;
    // A tetrahedron with a dent down to its centre.
    write(folder.path() / "dent.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nv 0.25 0.5 0.75\n"
                                      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\nf 3 4 5\nf 4 2 5\n");
    const auto collision = [](const char* name, const char* optimization) {
        return fmt::format("<collision name='{}'><geometry><mesh{}><uri>dent.obj</uri><scale>1 1 2</scale></mesh></geometry>"
                           "</collision>\n", name, optimization);
    };
    const std::string part = model("<link name='l'>" + collision("c", " optimization='convex_hull'") +
                                   collision("d", " optimization='convex_decomposition'") + collision("e", "") + "</link>");
    write(folder.path() / "part.sdf", part);
    const std::string with = model("<include><uri>part.sdf</uri><name>p</name></include>" + link("l") +
                                   joint("j", "fixed", "l", "p::l"));
    for (const auto& [text, index] : {std::pair(part, 0U), std::pair(with, 1U)}) {
        QuietContext context;
        const Robot robot = load_sdf(text, context, folder.path() / "robot.sdf");
        std::vector<MeshReference> meshes;
        for (const GeometryElement& element : robot.links.at(index).collisions) {
            meshes.push_back(std::get<MeshReference>(element.geometry));
            EXPECT_EQ(meshes.back().scale, (Vec3{1, 1, 2}));
        }
        ASSERT_EQ(meshes.size(), 3U);
        ASSERT_TRUE(meshes[0].mesh);
        EXPECT_NEAR(signed_volume(*meshes[0].mesh), 1, 1e-12);
        EXPECT_FALSE(meshes[1].mesh);
        EXPECT_FALSE(meshes[2].mesh);
    }
}

TEST(LoadSdf, ErrorsAboutWhatItDoesNotReadAreWarnings) {
    ListeningContext context;
    const std::string mass = "<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>5</izz></inertia></inertial>";
    const Robot robot = load_sdf(
        model(link("a", mass + "<sensor name='s' type='of_tomorrow'/>"
                               "<visual name='v'><geometry><sphere/></geometry><material><script><name>x</name></script>"
                               "</material></visual>")),
        context);
    EXPECT_EQ(robot.links.at(0).collisions.size(), 1U);
    EXPECT_EQ(robot.links[0].inertial.value().mass, 1);
    EXPECT_THAT(context.messages, Contains(HasSubstr("invalid inertia")));
    EXPECT_THAT(context.messages, Contains(HasSubstr("Sensor")));
    EXPECT_THAT(context.messages, Contains(HasSubstr("<script>")));
    for (const std::string& message : context.messages) {
        EXPECT_EQ(message.find("\\x0a"), message.npos) << message;
    }
}

TEST(LoadSdf, CountsWhatNoElementCovers) {
    ListeningContext context;
    const Robot robot = load_sdf(model("<link name='l'><collision name='p'><geometry><plane/></geometry></collision>"
                                       "<collision name='m'><geometry><box/></geometry><surface><contact>"
                                       "<collide_bitmask>0</collide_bitmask></contact></surface></collision></link>"),
                                 context);
    EXPECT_TRUE(robot.links.at(0).collisions.empty());
    EXPECT_THAT(context.messages, Contains(HasSubstr("1 plane or height field with contact")));
    EXPECT_THAT(context.messages, Contains(HasSubstr("1 collision with <collide_bitmask> 0")));
}

TEST(LoadSdf, FindsMeshesAndModels) {
    const TemporaryFolder folder;
    const auto file = [&](const char* name) { return folder.path() / name; };
    write(file("parts/tetrahedron.obj"), tetrahedron_obj);
    write(file("models/finger/model.config"),
          "<model><name>finger</name><sdf version='1.9'>model.sdf</sdf></model>");
    write(file("models/finger/meshes/tip.obj"), tetrahedron_obj);
    write(file("models/finger/model.sdf"),
          model("<link name='tip'><pose>0 0 1 0 0 0</pose><collision name='c'><geometry><mesh><uri>meshes/tip.obj</uri>"
                "<scale>1 2 3</scale></mesh></geometry></collision></link>"));
    const std::string robot_text = model(
        "<link name='l'><collision name='c'><geometry><mesh><uri>parts/tetrahedron.obj</uri></mesh></geometry></collision>"
        "</link><include><name>left</name><pose>1 0 0 0 0 0</pose><uri>models/finger</uri></include>" +
        joint("j", "fixed", "l", "left::tip"));
    QuietContext context;
    const Robot robot = load_sdf(robot_text, context, file("robot.sdf"));
    ASSERT_EQ(robot.links.size(), 2U);
    EXPECT_EQ(robot.root, "l");
    EXPECT_EQ(std::get<MeshReference>(robot.links[0].collisions.at(0).geometry).path, file("parts/tetrahedron.obj"));
    const auto& tip = std::get<MeshReference>(robot.links[1].collisions.at(0).geometry);
    EXPECT_EQ(robot.links[1].name, "left::tip");
    EXPECT_EQ(tip.path, file("models/finger/meshes/tip.obj"));
    EXPECT_EQ(tip.scale, (Vec3{1, 2, 3}));
    EXPECT_EQ(link_poses(robot).at("left::tip").translation, (Vec3{1, 0, 1}));
    const std::string missing = error_of(model("\n<include><uri>model://hand</uri></include>"), file("robot.sdf"));
    EXPECT_THAT(missing, AllOf(HasSubstr("robot.sdf:2: the model 'model://hand' that is included is not found; tried:"),
                               HasSubstr("remedy: --package hand=FOLDER")));
}

TEST(LoadSdf, ASubmeshIsAProblemOfWhoNeedsIt) {
    const auto mesh = std::get<MeshReference>(
        shape_of("<mesh><uri>a.dae</uri><submesh><name>tip</name></submesh></mesh>"));
    EXPECT_THAT(mesh.problem, HasSubstr("/none/robot.sdf:2: mesh 'a.dae' of link 'l': the part 'tip' of it is wanted"));
}

TEST(LoadSdf, JointsOfALoopAreLeftOutWithAWarning) {
    ListeningContext context;
    const std::string axis = "<axis><xyz>0 0 1</xyz></axis>";
    const Robot robot = load_sdf(model(link("a") + link("b") + link("c") + joint("ab", "revolute", "a", "b", axis) +
                                       joint("bc", "revolute", "b", "c", axis) + joint("ca", "revolute", "c", "a", axis) +
                                       joint("ac", "revolute", "a", "c", axis)),
                                 context);
    EXPECT_EQ(robot.root, "a");
    EXPECT_EQ(robot.joints.size(), 2U);
    EXPECT_THAT(context.messages, Contains(HasSubstr("leaves them out of the robot: ca, ac")));
}

TEST(LoadSdf, SeveralTreesStandInTheWorld) {
    const Robot robot = load_sdf(sdf("<world name='w'><model name='floor'><static>true</static>" + link("l") +
                                     "</model><model name='arm'>" + link("l") + "</model></world>"));
    EXPECT_EQ(robot.name, "w");
    EXPECT_EQ(robot.root, "world");
    ASSERT_EQ(robot.joints.size(), 2U);
    EXPECT_EQ(robot.joints[0].child, "floor::l");
    EXPECT_EQ(robot.joints[0].kind, Joint::Kind::fixed);
    EXPECT_EQ(robot.joints[1].child, "arm::l");
    EXPECT_EQ(robot.joints[1].kind, Joint::Kind::floating);
}

TEST(LoadSdf, ErrorsNameFileLineAndRemedy) {
    EXPECT_EQ(error_of("<robot/>"), "/none/robot.sdf:1: the root element of an SDF is <sdf>, not <robot>");
    EXPECT_EQ(error_of(sdf("")), "/none/robot.sdf:1: there is no <model>; remedy: a file with one");
    EXPECT_EQ(error_of(sdf("<model name='a'/>\n<model name='b'/>")),
              "/none/robot.sdf:2: the file has several <model>: a, b; remedy: put them into one <world>");
    EXPECT_THAT(error_of(shaped("<sphere><radius>-1</radius></sphere>")),
                HasSubstr("/none/robot.sdf:2: the radius of <sphere> is -1; remedy: a number above 0"));
    const std::string unknown = error_of(model("\n" + link("a") + "\n" + joint("j", "fixed", "a", "nobody")));
    EXPECT_THAT(unknown, AllOf(HasSubstr("/none/robot.sdf"), HasSubstr("libsdformat: "), HasSubstr("nobody"),
                               HasSubstr("remedy: correct it")));
}

TEST(LoadSdf, LibsdformatWarnsThroughFoamAlone) {
    ListeningContext context;
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    load_sdf(model("\n" + link("a", "<unheard_of/>")), context);
    EXPECT_EQ(testing::internal::GetCapturedStderr() + testing::internal::GetCapturedStdout(), "");
    EXPECT_THAT(context.messages, Contains(AllOf(HasSubstr("libsdformat: "), HasSubstr("unheard_of"))));
}

TEST(LoadSdf, ReadsMassesAndMaterials) {
    const Robot robot = load_sdf(model(
        "<link name='a'><inertial><pose>0 0 1 0 0 0</pose><mass>2</mass><inertia><ixx>1</ixx><iyy>2</iyy><izz>2.5</izz>"
        "<ixy>0.1</ixy></inertia></inertial><visual name='v'><geometry><sphere><radius>1</radius></sphere></geometry>"
        "<material><diffuse>1 0.5 0 1</diffuse></material></visual></link>"));
    const Inertial& inertial = robot.links.at(0).inertial.value();
    EXPECT_EQ(inertial.mass, 2);
    EXPECT_EQ(inertial.origin.translation, (Vec3{0, 0, 1}));
    EXPECT_EQ(inertial.moments.value(), (std::array{1.0, 2.0, 2.5, 0.1, 0.0, 0.0}));
    EXPECT_EQ(robot.links[0].visuals.at(0).material->rgba.value(), (std::array{1.0, 0.5, 0.0, 1.0}));
}

} // namespace
} // namespace foam::test
