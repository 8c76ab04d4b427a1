// What foam view reads.
#include "arm.hpp"

namespace foam::test {
namespace {

using ::testing::HasSubstr;

TEST_F(ArmTest, ReadsRobotWithColoursAndPoses) {
    const Subject read = subject(with({"arm.urdf"}));
    ASSERT_EQ(read.robots.size(), 1u);
    const ViewedRobot& robot = read.robots[0];
    EXPECT_TRUE(robot.judged);
    ASSERT_EQ(robot.links.size(), 4u);
    ASSERT_EQ(robot.links[0].visuals.size(), 1u);
    EXPECT_EQ(robot.links[0].visuals[0].colour, 0xFF8000FFu); // by the name of the robot's material
    EXPECT_EQ(robot.links[1].visuals[0].colour, 0x0000FF80u);
    EXPECT_EQ(robot.links[2].visuals.size(), 0u);
    EXPECT_EQ(robot.links[2].collisions.size(), 1u);
    ASSERT_GE(robot.poses.size(), 2u);
    EXPECT_EQ(robot.poses[0].name, "zero");
    EXPECT_EQ(robot.poses[0].configuration, (std::vector<double>{0, 0.01})); // zero moved into the limits
    EXPECT_THAT(robot.poses[1].configuration, ::testing::ElementsAre(0, ::testing::DoubleNear(0.03, 1e-12)));
    ASSERT_EQ(read.models.size(), 1u);
    EXPECT_EQ(read.models[0].spheres, std::vector<std::vector<Sphere>>(4));
}

TEST_F(ArmTest, TakesPosesFromAnSrdf) {
    write("arm.srdf", "<robot name=\"arm\"><group_state name=\"up\" group=\"g\"><joint name=\"turn\" value=\"1.5\"/>"
                      "</group_state></robot>");
    SubjectOptions options = with({"arm.urdf"});
    options.srdf = folder.path() / "arm.srdf";
    const ViewedRobot robot = subject(options).robots.at(0);
    EXPECT_EQ(robot.poses.back().name, "up");
    EXPECT_EQ(robot.poses.back().configuration, (std::vector<double>{1.5, 0.01}));
    write("arm.srdf",
          "<robot name=\"arm\">\n<group_state name=\"up\"><joint name=\"turn\" value=\"far\"/></group_state></robot>");
    EXPECT_THAT(refusal([&] { subject(options); }), HasSubstr("arm.srdf:2: "));
}

TEST_F(ArmTest, PutsModelsOnLinksOfTheRobotBeforeThem) {
    write("more.csv", "link,x,y,z,radius\nbase,0,0,0,0.2\nelsewhere,0,0,0,0.1\n");
    const Subject read = subject(with({"arm.urdf", "arm.csv", "more.csv"}));
    ASSERT_EQ(read.robots.size(), 1u);
    ASSERT_EQ(read.models.size(), 2u);
    EXPECT_EQ(read.models[0].spheres[1], (std::vector<Sphere>{{{0, 0, 0.2}, 0.20801}}));
    EXPECT_EQ(read.models[1].spheres[0].size(), 1u);
    ASSERT_EQ(read.notes.size(), 1u);
    EXPECT_THAT(read.notes[0], HasSubstr("more.csv: 1 sphere of links that arm.urdf does not have is not shown"));
}

TEST_F(ArmTest, AModelAloneIsShownAndNotJudged) {
    const Subject read = subject(with({"arm.csv"}));
    ASSERT_EQ(read.models.size(), 1u);
    EXPECT_FALSE(read.robots[0].judged);
    EXPECT_EQ(read.models[0].spheres.size(), 4u);
    EXPECT_THAT(read.notes.at(0), HasSubstr("remedy: foam view ROBOT MODEL"));
}

TEST_F(ArmTest, AUrdfOfSpheresIsAModelOfItself) {
    write("balls.urdf", "<robot name=\"b\"><link name=\"base\"><collision><geometry><sphere radius=\"0.1\"/></geometry>"
                        "</collision></link></robot>");
    const Subject alone = subject(with({"balls.urdf"}));
    EXPECT_FALSE(alone.robots[0].judged);
    EXPECT_EQ(alone.models[0].spheres[0], (std::vector<Sphere>{{{0, 0, 0}, 0.1}}));
    EXPECT_TRUE(alone.robots[0].links[0].collisions.empty());
    const Subject both = subject(with({"arm.urdf", "balls.urdf"}));
    EXPECT_EQ(both.robots.size(), 1u); // it shares the link "base"
    EXPECT_EQ(both.models[0].spheres[0].size(), 1u);
}

TEST_F(ArmTest, LinksAreJudgedByTheGeometryThatIsChosen) {
    const auto judged = [&](CoveredGeometry geometry) {
        SubjectOptions options = with({"arm.urdf"});
        options.geometry = geometry;
        std::vector<bool> links;
        const Subject shown = subject(options);
        for (const ViewedLink& link : shown.robots.at(0).links) {
            links.push_back(link.judged);
        }
        return links;
    };
    EXPECT_EQ(judged(CoveredGeometry::collision), (std::vector<bool>{true, true, true, true}));
    EXPECT_EQ(judged(CoveredGeometry::visual),
              (std::vector<bool>{true, true, false, false})); // fingers have no visuals
    write("visual.urdf",
          "<robot name=\"v\"><link name=\"v\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual>"
          "</link></robot>");
    SubjectOptions options = with({"visual.urdf"});
    const Subject without = subject(options);
    EXPECT_FALSE(without.robots[0].judged);
    EXPECT_TRUE(candidate_counts(without.robots[0]).empty());
    EXPECT_THAT(without.notes.at(0), HasSubstr("has no collision geometry"));
    options.geometry = CoveredGeometry::visual;
    EXPECT_EQ(candidate_counts(subject(options).robots[0]).front(), 1u);
}

TEST_F(ArmTest, AUrdfOfSpheresCanBeJudgedByItsVisuals) {
    write("ball.urdf",
          "<robot name=\"b\"><link name=\"base\"><visual><geometry><box size=\"0.1 0.1 0.1\"/></geometry></visual>"
          "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link></robot>");
    SubjectOptions options = with({"ball.urdf"});
    options.geometry = CoveredGeometry::visual;
    const Subject read = subject(options);
    EXPECT_TRUE(read.robots[0].judged);
    ASSERT_EQ(read.models.size(), 1u);
    EXPECT_EQ(read.models[0].spheres[0], (std::vector<Sphere>{{{0, 0, 0}, 0.1}}));
    const Original original = original_of(read.robots[0], options, registry);
    EXPECT_TRUE(verdicts_of(read.robots[0], original, read.models[0].spheres)[0]->holds);
}

TEST_F(ArmTest, AnotherRobotStandsBesideTheFirst) {
    write("box.urdf", "<robot name=\"box\"><link name=\"box\"><collision><geometry><box size=\"1 1 1\"/></geometry>"
                      "</collision></link></robot>");
    const Subject read = subject(with({"arm.urdf", "box.urdf"}));
    ASSERT_EQ(read.robots.size(), 2u);
    ASSERT_EQ(read.models.size(), 2u);
    EXPECT_EQ(read.models[1].robot, 1u);
}

TEST_F(ArmTest, AMeshHasTheColoursOfItsMaterials) {
    write("part.mtl", "newmtl red\nKd 1 0 0\nnewmtl glass\nKd 0 1 0\nd 0.5\n");
    write("part.obj",
          "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl red\nf 1 3 2\nf 1 2 4\nusemtl glass\n"
          "f 2 3 4\nusemtl missing\nf 1 4 3\n");
    const Subject read = subject(with({"part.obj"}));
    EXPECT_EQ(read.robots[0].links.at(0).visuals.at(0).mesh->colours,
              (std::vector<Colour>{0xFF0000FFu, 0xFF0000FFu, 0x00FF0080u, 0}));
}

TEST_F(ArmTest, AColladaMeshHasTheColoursOfItsEffects) {
    // Painted in a colour, with a texture (what it emits is no colour of it), and with nothing but what it emits.
    const std::pair<const char*, const char*> effects[] = {
        {"painted", "<emission><color>0 0 0 1</color></emission><diffuse><color>1 0 0 1</color></diffuse>"},
        {"textured",
         "<emission><color>0 0 0 1</color></emission><diffuse><texture texture='t' texcoord='u'/></diffuse>"},
        {"glowing", "<emission><color>0 0 1 1</color></emission>"}};
    std::string library, materials, triangles, bindings;
    for (const auto& [name, parts] : effects) {
        const std::string id = name;
        library += "<effect id='" + id + "-effect'><profile_COMMON><technique sid='common'><phong>" + parts +
                   "</phong></technique></profile_COMMON></effect>";
        materials += "<material id='" + id + "'><instance_effect url='#" + id + "-effect'/></material>";
        triangles += "<triangles material='" + id + "' count='1'><input semantic='VERTEX' source='#v' offset='0'/>" +
                     "<p>0 1 2</p></triangles>";
        bindings += "<instance_material symbol='" + id + "' target='#" + id + "'/>";
    }
    write("part.dae",
          "<COLLADA version='1.4.1'><library_effects>" + library + "</library_effects><library_materials>" + materials +
              "</library_materials><library_geometries><geometry id='g'><mesh><source id='p'><float_array id='a' "
              "count='9'>0 0 0 1 0 0 0 1 0</float_array><technique_common><accessor source='#a' count='3' stride='3'/>"
              "</technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>" +
              triangles +
              "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='s'><node>"
              "<instance_geometry url='#g'><bind_material><technique_common>" +
              bindings +
              "</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>"
              "<scene><instance_visual_scene url='#s'/></scene></COLLADA>");
    const Subject read = subject(with({"part.dae"}));
    EXPECT_EQ(read.robots[0].links.at(0).visuals.at(0).mesh->colours,
              (std::vector<Colour>{0xFF0000FFu, 0, 0x0000FFFFu}));
}

TEST_F(ArmTest, AMissingVisualMeshIsLeftOutWithANote) {
    std::string text = arm_urdf;
    text.replace(text.find("<box size=\"0.2 0.2 0.1\"/>"), 25, "<mesh filename=\"none.stl\"/>");
    write("arm.urdf", text);
    const Subject read = subject(with({"arm.urdf"}));
    EXPECT_TRUE(read.robots[0].links[0].visuals.empty());
    EXPECT_EQ(read.robots[0].links[1].visuals.at(0).colour, 0x0000FF80u);
    ASSERT_FALSE(read.notes.empty());
    EXPECT_THAT(read.notes[0], HasSubstr("none.stl"));
}

} // namespace
} // namespace foam::test
