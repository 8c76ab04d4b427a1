// What load.mjcf refuses, and what it says.
#include "loading.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

std::string error_of(const std::string& text, const std::filesystem::path& file = "/none/robot.xml") {
    try {
        QuietContext context;
        load_mjcf(text, context, file);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        return error.what();
    }
    return "no error";
}

std::string error_in_world(const std::string& content, const std::string& before = "") {
    return error_of("<mujoco>" + before + "\n<worldbody>\n" + content + "\n</worldbody></mujoco>");
}

TEST(LoadMjcfErrors, NamesFileLineAndRemedy) {
    EXPECT_EQ(error_of("<robot/>"), "/none/robot.xml:1: the root element of an MJCF is <mujoco>, not <robot>");
    EXPECT_EQ(error_in_world("<geom size='a'/>"), "/none/robot.xml:3: <geom size=\"a\">: 'a' is not a finite number");
    EXPECT_EQ(error_in_world("<geom size='0'/>"), "/none/robot.xml:3: <geom size=\"0\">: a size must be above 0");
    EXPECT_EQ(error_in_world("<geom type='box' size='1'/>"),
              "/none/robot.xml:3: <geom size=\"1\">: a box needs 3 numbers");
    EXPECT_EQ(error_in_world("<geom type='sdf'/>"),
              "/none/robot.xml:3: <geom type=\"sdf\">: it names no mesh; remedy: mesh=\"…\"");
    EXPECT_EQ(error_in_world("<geom size='1' quat='1 0 0 0' euler='0 0 0'/>"),
              "/none/robot.xml:3: it states two orientations; remedy: one of quat, axisangle, euler, xyaxes, zaxis");
    EXPECT_EQ(error_in_world("<geom size='1' class='armm'/>", "<default><default class='arm'/></default>"),
              "/none/robot.xml:3: there is no default class 'armm'; did you mean 'arm'?");
    EXPECT_EQ(error_in_world("<body name='a'/>\n<body name='a'/>"),
              "/none/robot.xml:4: a second body 'a'; remedy: another name");
    EXPECT_EQ(error_in_world("<body><joint range='1 0'/></body>"),
              "/none/robot.xml:3: <joint range=\"1 0\">: the first number of a range is below the second");
    EXPECT_EQ(error_in_world("<replicate count='0'/>"),
              "/none/robot.xml:3: <replicate count=\"0\">: it expects a whole number of at least 1");
    EXPECT_EQ(
        error_in_world("<composite/>"),
        "/none/robot.xml:3: <composite> is not read; remedy: let MuJoCo write it out, by mujoco.mj_saveLastXML()");
}

TEST(LoadMjcfErrors, OfDefaultsNamesTheDefault) {
    EXPECT_EQ(
        error_of(
            "<mujoco><default>\n<geom type='ball'/></default>\n<worldbody>\n<geom size='1'/></worldbody></mujoco>"),
        "/none/robot.xml:2: <geom type=\"ball\">: it is none of plane, hfield, sphere, capsule, ellipsoid, cylinder, "
        "box, mesh, sdf");
}

TEST(LoadMjcfErrors, ListsWhereAFileWasSearched) {
    EXPECT_EQ(error_of("<mujoco><include file='a.xml'/></mujoco>"),
              "/none/robot.xml:1: the file 'a.xml' that is included is not found; tried:\n  /none/a.xml");
    EXPECT_EQ(
        error_of("<mujoco><compiler meshdir='m'/><asset>\n<mesh name='t' file='t.stl'/></asset>\n<worldbody><geom "
                 "type='mesh' mesh='t'/></worldbody></mujoco>"),
        "/none/robot.xml:2: the mesh 't.stl', which the geom in /none/robot.xml:3 names, is not found; tried:\n"
        "  /none/m/t.stl\n  /none/t.stl\nremedy: correct the path, or meshdir of <compiler>");
    EXPECT_EQ(error_in_world("<geom type='mesh' mesh='ab'/>",
                             "<asset><mesh name='abc' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>"),
              "/none/robot.xml:3: <geom mesh=\"ab\">: there is no such mesh; did you mean 'abc'?");
}

TEST(LoadMjcfErrors, OfAFileThatIsNotReadSayWhy) {
    const TemporaryFolder folder;
    const std::filesystem::path large = folder.path() / "large.xml";
    write(large.string(), "");
    std::filesystem::resize_file(large, 200'000'001); // takes no room on the disk
    for (const char* content : {"<include file='large.xml'/>", "<asset><model name='m' file='large.xml'/></asset>"}) {
        EXPECT_THAT(error_of(std::string("<mujoco>") + content + "</mujoco>", folder.path() / "robot.xml"),
                    testing::AllOf(testing::StartsWith(large.string() + ": "), testing::EndsWith("remedy: leave it out")));
    }
}

TEST(LoadMjcfErrors, OfFilesThatLeadToThemselves) {
    const TemporaryFolder folder;
    const auto file = [&](const char* name) { return (folder.path() / name).string(); };
    write(file("a.xml"), "<mujoco><include file='a.xml'/></mujoco>");
    EXPECT_EQ(error_of("<mujoco><include file='a.xml'/></mujoco>", file("robot.xml")),
              file("a.xml") + ":1: the file 'a.xml' is included twice; remedy: keep one <include>");
    write(file("b.xml"), "<mujoco><asset><model name='b' file='b.xml'/></asset></mujoco>");
    EXPECT_EQ(error_of("<mujoco><asset><model name='b' file='b.xml'/></asset></mujoco>", file("robot.xml")),
              file("b.xml") + ":1: models attach models more than 20 deep");
    EXPECT_EQ(error_in_world("<body name='a'><attach body='a' prefix='p'/></body>"),
              "/none/robot.xml:3: <attach> leads to itself");
}

TEST(LoadMjcfErrors, OfAFlatMesh) {
    EXPECT_EQ(error_in_world("<geom type='mesh' mesh='m'/>",
                             "<asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 1 1 0'/></asset>")
                  .substr(0, 26),
              "/none/robot.xml:1: mesh ''");
}

} // namespace
} // namespace foam::test
