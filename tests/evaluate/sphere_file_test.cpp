// Every format that is read, by a minimal example; and what is said of files that are wrong.
#include "evaluate/files.hpp"
#include "support/shared_folder.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::ElementsAre;

const Sphere one{{0.1, 0.2, 0.3}, 0.05}, two{{-1, 0, 2.5}, 0.25};

/// Two spheres of link l, and one of m.
void expect_both_links(const SphereFile& file, const std::string& format) {
    EXPECT_EQ(file.format, format);
    ASSERT_EQ(file.links.size(), 2u);
    EXPECT_EQ(file.links[0].link, "l");
    EXPECT_THAT(file.links[0].elements.spheres(), ElementsAre(one, two));
    EXPECT_EQ(file.links[1].link, "m");
    EXPECT_THAT(file.links[1].elements.spheres(), ElementsAre(one));
    EXPECT_THAT(file.notes, ElementsAre());
}

void expect_nameless(const SphereFile& file, const std::string& format) {
    EXPECT_EQ(file.format, format);
    ASSERT_EQ(file.links.size(), 1u);
    EXPECT_EQ(file.links[0].link, "");
    EXPECT_THAT(file.links[0].elements.spheres(), ElementsAre(one, two));
}

const std::string lists = "{l: [{center: [0.1, 0.2, 0.3], radius: 0.05}, {center: [-1, 0, 2.5], radius: 0.25}], "
                          "m: [{center: [0.1, 0.2, 0.3], radius: 0.05}]}";

using SphereFiles = Files;

TEST_F(SphereFiles, Urdf) {
    expect_both_links(read(R"(<?xml version="1.0"?>
<robot name="r">
  <link name="l">
    <collision><origin xyz="0.1 0.2 0.3" rpy="0 0 0"/><geometry><sphere radius="0.05"/></geometry></collision>
    <collision><origin xyz="-1 0 2.5"/><geometry><sphere radius="0.25"/></geometry></collision>
  </link>
  <link name="m"><collision><origin xyz="0.1 0.2 0.3"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="j" type="revolute"><parent link="l"/><child link="m"/><limit effort="1" velocity="1"/></joint>
</robot>)"),
                      "URDF");
}

TEST_F(SphereFiles, UrdfWithOtherGeometryAndSpheresOfNoSize) {
    const SphereFile file = read(R"(<robot name="r">
  <link name="l">
    <collision><geometry><mesh filename="package://nowhere/m.stl"/></geometry></collision>
    <collision><geometry><box size="1 1 1"/></geometry></collision>
    <collision><geometry><sphere radius="0"/></geometry></collision>
    <collision><origin xyz="-1 0 2.5"/><geometry><sphere radius="0.25"/></geometry></collision>
  </link>
</robot>)");
    EXPECT_THAT(file.links.at(0).elements.spheres(), ElementsAre(two));
    ASSERT_EQ(file.links.at(0).elements.shaped().size(), 1U);
    EXPECT_EQ(file.links.at(0).elements.shaped()[0], (Element{.kind = Element::Kind::box, .half = {0.5, 0.5, 0.5}}));
    EXPECT_THAT(
        file.notes,
        ElementsAre("link 'l' has collision geometry that is no convex element (a mesh that is not found), which "
                    "is not judged",
                    "1 sphere of a radius not above 0 is switched off and left out"));
}

TEST_F(SphereFiles, UrdfWithCapsulesAndCylinders) {
    const SphereFile file = read(R"(<robot name="r" version="1.1">
  <link name="l">
    <collision><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><geometry><capsule radius="0.1" length="0.5"/></geometry></collision>
    <collision><geometry><cylinder radius="0.25" length="2"/></geometry></collision>
  </link>
</robot>)");
    const Pose pose = Pose::from_xyz_rpy({1, 2, 3}, {0.1, 0.2, 0.3});
    EXPECT_EQ(file.links.at(0).elements,
              Elements(std::vector<Element>{{.kind = Element::Kind::capsule, .pose = pose, .half = {0, 0, 0.25}, .radius = 0.1},
                                    {.kind = Element::Kind::cylinder, .half = {0, 0, 1}, .radius = 0.25}}));
}

TEST_F(SphereFiles, FoamJsonWithElements) {
    const SphereFile file = read(R"({"foam_spheres": 2, "name": "r", "links": {"l": {"spheres": [], "elements": [
  {"kind": "box", "position": [1, 2, 3], "size": [2, 4, 6]},
  {"kind": "hull", "position": [0, 0, 0], "vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}]}}})");
    ASSERT_EQ(file.links.at(0).elements.shaped().size(), 2U);
    EXPECT_EQ(file.links[0].elements.shaped()[0],
              (Element{.kind = Element::Kind::box, .pose = {.translation = {1, 2, 3}}, .half = {1, 2, 3}}));
    EXPECT_EQ(file.links[0].elements.shaped()[1].hull->surface.vertices.size(), 4U);
    EXPECT_THAT(
        refusal(
            R"({"foam_spheres": 2, "links": {"l": {"spheres": [], "elements": [{"kind": "box", "position": [0, 0, 0]}]}}})"),
        ::testing::EndsWith("a box needs 'size'"));
}

TEST_F(SphereFiles, FoamJson) {
    expect_both_links(read(R"({"foam_spheres": 1, "name": "r", "links": {
  "l": {"spheres": [[0.1, 0.2, 0.3, 0.05], [-1, 0, 2.5, 0.25]], "groups": []}, "m": {"spheres": [[0.1, 0.2, 0.3, 0.05]]}}})"),
                      "foam JSON");
    EXPECT_EQ(refusal(R"({"foam_spheres": 3, "links": {}})"), "FILE:1:18: foam_spheres is 3; this foam reads 1 and 2");
}

TEST_F(SphereFiles, CsvAndPly) {
    expect_both_links(read("link,x,y,z,radius\nl,0.1,0.2,0.3,0.05\nl,-1,0,2.5,0.25\nm,0.1,0.2,0.3,0.05\n"), "CSV");
    expect_both_links(read("ply\nformat ascii 1.0\ncomment link 0 l\ncomment link 1 m\nelement vertex 3\n"
                           "property double x\nproperty double y\nproperty double z\nproperty double radius\n"
                           "property int link\nend_header\n0.1 0.2 0.3 0.05 0\n-1 0 2.5 0.25 0\n0.1 0.2 0.3 0.05 1\n"),
                      "PLY");
    EXPECT_EQ(refusal("link,x,y,z,radius\nl,0.1,0.2,0.3,abc\n"),
              "FILE: CSV: row 2: 'abc' is not a finite number; remedy: write the file again with write.csv");
}

TEST_F(SphereFiles, DatabaseOfTheFirstFoam) {
    const std::string level = R"({"mean": 0, "best": null, "worst": 1, "spheres": )";
    expect_both_links(read(R"({"l::a.stl": {"8": {"0": )" + level + R"([]}, "1": )" + level +
                           R"([{"origin": [0.1, 0.2, 0.3], "radius": 0.05}]}}}, "l::a.stl#2": {"8": {"10": )" + level +
                           R"([{"origin": [-1, 0, 2.5], "radius": 0.25}]}, "9": )" + level +
                           R"([]}}}, "m::package://p/m.stl": {"2": {"1": )" + level +
                           R"([{"origin": [0.1, 0.2, 0.3], "radius": 0.05}]}}}})"),
                      "database of CoMMALab/foam");
    expect_nameless(
        read("[" + level + "[]}, " + level +
             R"([{"origin": [0.1, 0.2, 0.3], "radius": 0.05}, {"origin": [-1, 0, 2.5], "radius": 0.25}]}])"),
        "list of CoMMALab/foam");
}

TEST_F(SphereFiles, CuRobo) {
    expect_both_links(read("# comment\nrobot_cfg:\n  kinematics:\n    base_link: l\n    collision_spheres: " + lists +
                           "\n    collision_sphere_buffer: 0.0\n"),
                      "cuRobo YAML");
    EXPECT_THAT(
        read("kinematics:\n  collision_sphere_buffer: 0.005\n  collision_spheres: " + lists).notes,
        ElementsAre("collision_sphere_buffer (line 2) belongs to the radii: the program that uses the file adds it"));
    EXPECT_EQ(refusal("robot_cfg:\n  kinematics:\n    collision_spheres: spheres/franka.yml\n"),
              "FILE:3:24: the spheres are in another file, 'spheres/franka.yml'; remedy: give that one");
}

TEST_F(SphereFiles, CuRoboUsesOnlyTheLinksThatItNames) {
    const SphereFile file = read("kinematics:\n  collision_link_names: [m]\n  collision_spheres: " + lists + "\n");
    ASSERT_EQ(file.links.size(), 1U);
    EXPECT_EQ(file.links[0].link, "m");
    EXPECT_THAT(file.notes,
                ElementsAre("2 spheres of link 'l' are left out: collision_link_names (line 2) does not name "
                            "it, so that cuRobo does not use that link"));
    expect_both_links(read("kinematics:\n  collision_link_names: [m, l]\n  collision_spheres: " + lists + "\n"),
                      "cuRobo YAML");
}

TEST_F(SphereFiles, CuRoboWithoutSpheres) {
    EXPECT_EQ(refusal("kinematics:\n  collision_link_names: null\n  collision_spheres: null\n"),
              "FILE:3:22: collision_spheres is null: there are no spheres in this file; remedy: `foam convert MODEL "
              "--into FILE -o OUT` writes those of a model into it");
}

TEST_F(SphereFiles, ANegativeRadiusSwitchesASphereOff) {
    const SphereFile file =
        read("collision_spheres: {l: [{center: [0, 0, 0], radius: -1}, {center: [0, 0, 0], radius: -10}, "
             "{center: [-1, 0, 2.5], radius: 0.25}]}");
    EXPECT_THAT(file.links.at(0).elements.spheres(), ElementsAre(two));
    EXPECT_THAT(file.notes, ElementsAre("2 spheres of a radius not above 0 are switched off and left out"));
}

TEST_F(SphereFiles, RefusesNumbersThatNoFigureHolds) {
    EXPECT_EQ(
        refusal("l 0 0 0 1e300\n"),
        "FILE: the sphere [0, 0, 0, 1e+300] of link 'l' is farther away or larger than 1e+20 m, where figures and "
        "proofs have no meaning; remedy: correct the file");
    EXPECT_EQ(refusal("l 0 0 0 1\nm 0 -1e21 0 1\n"),
              "FILE: the sphere [0, -1e+21, 0, 1] of link 'm' is farther away or larger than 1e+20 m, where figures "
              "and proofs have no meaning; remedy: correct the file");
    EXPECT_EQ(read("l 0 0 1e20 1e20\n").links.size(), 1u);
}

TEST_F(SphereFiles, Lula) {
    expect_both_links(read(R"(api_version: 1.0
collision_spheres:
  - l:
    - "center": [0.1, 0.2, 0.3]
      "radius": 0.05
    - center: [-1, 0.0, 2.5]
      radius: 0.25
  - m:
    - {center: [0.1, 0.2, 0.3], radius: 0.05}
)"),
                      "Lula YAML");
}

TEST_F(SphereFiles, Xrdf) {
    for (const char* key : {"collision", "world_collision"}) {
        expect_both_links(
            read("format: xrdf\nformat_version: 1.0\n" + std::string(key) +
                 ": {geometry: g, buffer_distance: {l: 0.0}}\ngeometry: {other: {spheres: {}}, g: {spheres: " + lists +
                 "}}\n"),
            "XRDF");
    }
    EXPECT_EQ(refusal("format: xrdf\ncollision: {geometry: g}\ngeometry: {h: {}}\n"),
              "FILE:3:11: expected a map with the key 'g', got one without");
}

TEST_F(SphereFiles, XrdfClonesGeometry) {
    const std::string begin = "format: xrdf\ncollision: {geometry: all}\ngeometry:\n";
    expect_both_links(read(begin + "  arm: {spheres: {l: [{center: [0.1, 0.2, 0.3], radius: 0.05}]}}\n"
                                   "  tip: {clone: arm, spheres: {l: [{center: [-1, 0, 2.5], radius: 0.25}]}}\n"
                                   "  all: {clone: [tip, rest]}\n"
                                   "  rest: {spheres: {m: [{center: [0.1, 0.2, 0.3], radius: 0.05}]}}\n"),
                      "XRDF");
    EXPECT_EQ(refusal(begin + "  all: {clone: [other]}\n"),
              "FILE:4:17: 'other' is cloned, but there is no such geometry; there is all");
    EXPECT_EQ(refusal(begin + "  all: {clone: [a]}\n  a: {clone: [all]}\n"),
              "FILE:5:15: geometry 'all' clones itself; remedy: delete this name");
    EXPECT_EQ(refusal(begin + "  all: {clone: [[a]]}\n  a: {}\n"),
              "FILE:4:17: expected the name of a geometry, got a list");
    EXPECT_EQ(refusal(begin + "  all: {boxes: {}}\n"),
              "FILE:4:8: geometry 'all' has neither spheres nor clone; remedy: add one of them");
    // Each name once, however often it is cloned.
    EXPECT_THAT(
        read(begin + "  all: {clone: [a, b]}\n  a: {clone: [c]}\n  b: {clone: [c]}\n  c: {spheres: " + lists + "}\n")
            .links.at(0)
            .elements.spheres(),
        ElementsAre(one, two));
}

TEST_F(SphereFiles, XrdfWithSpheresForSelfCollisionAlone) {
    const std::string geometry = "geometry:\n  g: {spheres: " + lists + "}\n  s: {clone: [g]}\n";
    EXPECT_THAT(read("format: xrdf\nworld_collision: {geometry: g}\nself_collision: {geometry: s}\n" + geometry).notes,
                ElementsAre("self_collision (line 3) has a geometry of its own, 's', which is not judged: 'g' of "
                            "world_collision is"));
    EXPECT_THAT(read("format: xrdf\ncollision: {geometry: g}\nself_collision: {geometry: g}\n" + geometry).notes,
                ElementsAre());
}

TEST_F(SphereFiles, ABufferSwitchesSpheresOnAndOff) {
    const std::string spheres = "{l: [{center: [0, 0, 0], radius: -0.01}, {center: [-1, 0, 2.5], radius: 0.25}], "
                                "m: [{center: [0, 0, 0], radius: -0.01}]}";
    const SphereFile xrdf = read("format: xrdf\ncollision:\n  geometry: g\n  buffer_distance: {l: 0.025, m: 0.01}\n"
                                 "geometry: {g: {spheres: " +
                                 spheres + "}}\n");
    const auto larger = [](Sphere sphere, double by) {
        sphere.radius += by;
        return sphere;
    };
    EXPECT_THAT(xrdf.links.at(0).elements.spheres(), ElementsAre(larger({{0, 0, 0}, -0.01}, 0.025), larger(two, 0.025)));
    EXPECT_THAT(xrdf.links.at(1).elements.spheres(), ElementsAre());
    EXPECT_THAT(xrdf.notes,
                ElementsAre("buffer_distance (line 4) belongs to the radii: the program that uses the file adds it",
                            "1 sphere of a radius not above 0 is switched off and left out"));
    EXPECT_THAT(read("kinematics:\n  self_collision_buffer: {l: -0.01}\n  collision_spheres: " + lists).notes,
                ElementsAre("self_collision_buffer (line 2) changes the radii where the robot is checked against itself: "
                            "figures, proofs and pairs are without it"));
    const SphereFile curobo = read("kinematics:\n  collision_sphere_buffer: -0.2\n  collision_spheres: " + lists);
    EXPECT_THAT(curobo.links.at(0).elements.spheres(), ElementsAre(larger(two, -0.2)));
    EXPECT_THAT(curobo.notes,
                ElementsAre("collision_sphere_buffer (line 2) belongs to the radii: the program that uses the file adds it",
                            "the buffer switches 2 spheres off, which are left out (the first: link 'l', 0.05 m - 0.2 "
                            "m)"));
    EXPECT_EQ(refusal("kinematics: {collision_sphere_buffer: {l: x}, collision_spheres: " + lists + "}"),
              "FILE:1:43: expected a finite number of metres, got the text 'x'");
}

TEST_F(SphereFiles, MorphItBallparkAndPyroki) {
    const std::string columns = R"({"centers": [[0.1, 0.2, 0.3], [-1, 0, 2.5]], "radii": [0.05, 0.25]})";
    expect_nameless(read(columns), "MorphIt JSON");
    expect_both_links(read(R"({"l": )" + columns + R"(, "m": {"centers": [[0.1, 0.2, 0.3]], "radii": [0.05]}})"),
                      "centers and radii by link");
    EXPECT_EQ(refusal(R"({"centers": [[0, 0, 0]], "radii": [1, 2]})"), "FILE:1:1: 1 centers and 2 radii");
}

TEST_F(SphereFiles, BubblifyAndPlainmp) {
    expect_both_links(read("collision_spheres: " + lists + "\nmetadata: {}\n"), "collision_spheres YAML");
    expect_both_links(
        read("collision_spheres: {l: {spheres: [[0.1, 0.2, 0.3, 0.05], [-1, 0, 2.5, 0.25]]}, m: {spheres: "
             "[[0.1, 0.2, 0.3, 0.05]]}}\n"),
        "plainmp YAML");
}

TEST_F(SphereFiles, RowsOfNumbers) {
    expect_both_links(read("# GPMP2\nl 0.1 0.2 0.3 0.05\nl -1 0 2.5 0.25   % elbow\n\nm 0.1 0.2 0.3 0.05\n"),
                      "GPMP2 rows");
    expect_both_links(read("% sphere data [link x y z r]\n\n# more\n  % and more\nl 0.1 0.2 0.3 0.05\nl -1 0 2.5 0.25\n"
                           "m 0.1 0.2 0.3 0.05\n"),
                      "GPMP2 rows");
    expect_nameless(read("0.1,0.2,0.3,0.05\n-1,0,2.5,0.25\n"), "rows of numbers");
    EXPECT_EQ(refusal("0 0 0 1\n0 0 0 1 1\n"),
              "FILE:2: a row of 5 fields after rows of 4; remedy: give all rows the same");
    EXPECT_EQ(refusal("0 0 0 1\n0 0 nan 1\n"), "FILE:2: 'nan' is not a finite number");
    EXPECT_EQ(refusal("0 0 0 1 2 3\n"), "FILE:1: a row of 6 fields; expected are x y z radius, or link x y z radius");
}

TEST_F(SphereFiles, SpheresByLink) {
    expect_both_links(
        read(
            R"({"robot": "r", "spheres": {"l": [[0.1, 0.2, 0.3, 0.05], [-1, 0, 2.5, 0.25]], "m": [[0.1, 0.2, 0.3, 0.05]]}})"),
        "spheres by link");
}

TEST_F(SphereFiles, WhatIsWrongIsSaidWithItsPlace) {
    EXPECT_EQ(refusal(""), "FILE: the file is empty; a sphere model is needed");
    EXPECT_EQ(refusal("collision_spheres:\n  l:\n  - center: [0, 0]\n    radius: 1\n"),
              "FILE:3:13: expected three numbers, got 2");
    EXPECT_EQ(refusal("collision_spheres:\n  l:\n  - center: [0, 0, x]\n    radius: 1\n"),
              "FILE:3:20: expected a finite number of metres, got the text 'x'");
    EXPECT_EQ(refusal("collision_spheres:\n  l:\n  - center: [0, 0, 0]\n    radius: .nan\n"),
              "FILE:4:13: expected a finite number of metres, got .nan");
    EXPECT_EQ(refusal("collision_spheres:\n  l:\n  - center: [0, 0, 0]\n    radius: .inf\n"),
              "FILE:4:13: expected a finite number of metres, got .inf");
    EXPECT_EQ(refusal("collision_spheres:\n  l:\n  - center: [0, 0, 0]\n"),
              "FILE:3:5: expected a map with the key 'radius', got one without");
    EXPECT_EQ(refusal("collision_spheres:\n  l: []\n  l: []\n"),
              "FILE:3:3: key 'l' is given twice, first in line 2; remedy: delete one");
    EXPECT_EQ(refusal(R"({"collision_spheres": {"l": [[0, 0, 0]]}})"),
              "FILE:1:30: expected a sphere [x, y, z, radius], got a list of 3");
    EXPECT_EQ(refusal(R"({"collision_spheres": {"l": [[0, 0, 0, 1]]})"),
              "FILE:1:1: this '{' is never closed, or a ',' is missing in it; remedy: complete it");
    EXPECT_EQ(
        refusal(
            "<robot name=\"r\"><link name=\"l\"><collision><geometry><sphere radius=\"big\"/></geometry></collision>"
            "</link></robot>"),
        "FILE:1: <sphere radius>: 'big' is not a finite number");
    const std::string unknown =
        "FILE: no reader recognises this file as a sphere model; remedy: `foam formats` lists what is read, and "
        "--reader NAME shows the error of one reader";
    EXPECT_EQ(refusal("{\"a\": 1}"), unknown);
    EXPECT_EQ(refusal("just words"), unknown);
}

TEST_F(SphereFiles, AGivenReaderSaysWhatIsWrong) {
    const std::string text = "{\"spheres\": {\"l\": [[0, 0, 0, 1]]}}";
    EXPECT_EQ(parse_sphere_file(text, "a.json", registry, "read.spheres_by_link").links.size(), 1u);
    try {
        parse_sphere_file(text, "a.json", registry, "read.curobo");
        ADD_FAILURE() << "it is no file of cuRobo";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "a.json:1:1: expected a map with the key 'kinematics', got one without");
    }
    try {
        parse_sphere_file(text, "a.json", registry, "read.curbo");
        ADD_FAILURE() << "there is no such reader";
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(), "unknown stage 'read.curbo'; did you mean 'read.curobo'?");
    }
}

TEST_F(SphereFiles, KeysWithinTextsAndListsAreNoKeys) {
    expect_both_links(read(R"({"note": "collision_spheres: {", 'list': [{"spheres": 1}], "spheres":
{"l": [[0.1, 0.2, 0.3, 0.05], [-1, 0, 2.5, 0.25]], "m": [[0.1, 0.2, 0.3, 0.05]]}})"),
                      "spheres by link");
    expect_both_links(read("'a:b': 1\n# collision_spheres:\nurl: http://x\n\"spheres\" : " + lists + "\n"),
                      "spheres by link");
}

TEST_F(SphereFiles, FilesOfTheirPrograms) {
    const std::filesystem::path theirs = shared_folder() / "reference_formats";
    if (!std::filesystem::exists(theirs)) {
        GTEST_SKIP() << theirs << " is not there";
    }
    struct Expected {
        const char* file;
        const char* format;
        std::size_t links, spheres, notes;
    };
    for (const Expected& expected :
         {Expected{"curobo/ur10e_v0.8.yml", "cuRobo YAML", 7, 19, 3}, Expected{"xrdf/ur10e_1.0.xrdf", "XRDF", 7, 19, 3},
          Expected{"xrdf/ur10_2.0.xrdf", "XRDF", 4, 36, 1},
          Expected{"lula/ur5e_robot_description.yaml", "Lula YAML", 6, 39, 0},
          Expected{"bubblify/xarm6_rs_spherized.yml", "collision_spheres YAML", 2, 9, 0},
          Expected{"plainmp/panda.yaml", "plainmp YAML", 9, 72, 0},
          Expected{"morphit/fanuc_m20ia_link_1.json", "MorphIt JSON", 1, 20, 0},
          Expected{"gpmp2/wam_arm_rows.txt", "GPMP2 rows", 6, 16, 1}}) {
        SCOPED_TRACE(expected.file);
        const SphereFile file = read_sphere_file(theirs / expected.file, registry);
        std::size_t spheres = 0;
        for (const LinkSpheres& link : file.links) {
            spheres += link.elements.spheres().size();
        }
        EXPECT_EQ(file.format, expected.format);
        EXPECT_EQ(file.links.size(), expected.links);
        EXPECT_EQ(spheres, expected.spheres);
        EXPECT_THAT(file.notes, ::testing::SizeIs(expected.notes));
    }
}

TEST_F(SphereFiles, AFileThatIsNotThere) {
    EXPECT_THROW(read_sphere_file("/nowhere/at/all.json", registry), Error);
}

} // namespace
} // namespace foam::test
