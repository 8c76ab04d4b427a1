// write.sdf and read.sdf.
#include "plugin_stages.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::HasSubstr;

const Format sdf{"write_sdf", "write.sdf", "read.sdf"};

SphereModel cup() {
    SphereModel model =
        model_of(chain_of({"c<u>p"}), {group_of("c<u>p", {}, flat_tree({{{1, -0.2, 3}, 0.5}, {{0, 0, 0}, 1}}))});
    model.provenance = "a -- b";
    return model;
}

TEST(WriteSdf, WritesAnObject) {
    EXPECT_EQ(sdf.text(cup()),
              "<?xml version=\"1.0\"?>\n<!-- a - - b -->\n<sdf version=\"1.9\">\n"
              "  <model name=\"chain\">\n    <static>true</static>\n    <link name=\"c&lt;u&gt;p\">\n"
              "      <collision name=\"sphere_0\">\n        <pose>1 -0.2 3 0 0 0</pose>\n"
              "        <geometry><sphere><radius>0.5</radius></sphere></geometry>\n      </collision>\n"
              "      <collision name=\"sphere_1\">\n        <pose>0 0 0 0 0 0</pose>\n"
              "        <geometry><sphere><radius>1</radius></sphere></geometry>\n      </collision>\n"
              "    </link>\n  </model>\n</sdf>\n");
    EXPECT_THAT(sdf.text(cup(), {{"static", false}}), HasSubstr("<static>false</static>"));
}

TEST(WriteSdf, WritesARobot) {
    const std::string text = sdf.text(turned_model());
    EXPECT_THAT(text, HasSubstr("<parent>base</parent>\n      <child>tool</child>\n"));
    EXPECT_EQ(read_spheres(*writer("write_sdf", "write.sdf"), text), spheres_of(turned_model()));
}

TEST(WriteSdf, RefusesSeveralLinksOfNoRobot) {
    SphereModel model = turned_model();
    model.robot.reset();
    EXPECT_THAT(refusal(*writer("write_sdf", "write.sdf"), model), HasSubstr("remedy: name the robot"));
}

TEST(WriteSdf, HostileNames) {
    sdf.expect_hostile_names(true);
}

TEST(ReadSdf, SaysWhatIsWrongAndWhere) {
    const auto collision = [](const std::string& content) {
        return sdf.message("<sdf>\n<model name='m'><link name='l'><collision>\n" + content +
                           "</collision></link></model></sdf>");
    };
    EXPECT_THAT(collision("<geometry><sphere><radius>nan</radius></sphere></geometry>"),
                HasSubstr("FILE:3: <radius>: 'nan' is not a finite number"));
    EXPECT_THAT(collision("<geometry><sphere/></geometry>"), HasSubstr("FILE:3: a sphere needs one <radius>"));
    EXPECT_THAT(collision("<pose>1 2</pose><geometry><sphere><radius>1</radius></sphere></geometry>"),
                HasSubstr("FILE:3: <pose> has 2 numbers"));
    EXPECT_THAT(
        collision("<pose relative_to='x'>1 2 3 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry>"),
        HasSubstr("placed in the frame 'x'; remedy"));
    EXPECT_EQ(collision("<pose relative_to='l'/><geometry><sphere><radius>1</radius></sphere></geometry>"), "");
    EXPECT_THAT(sdf.message("<sdf/>"), HasSubstr("there is no <model>"));
    EXPECT_THAT(sdf.message("<robot/>"), HasSubstr("not <sdf>"));
    sdf.expect_truncations(sdf.text(cup()));
}

TEST(ReadSdf, RecognisesSdfOnly) {
    const auto reader = sdf.reader();
    EXPECT_TRUE(reader->recognises(sdf.text(cup())));
    EXPECT_TRUE(reader->recognises("<!-- <robot> --><sdf version='1.9'>"));
    for (const char* text : {"<robot name='sdf'/>", "<!-- <sdf> --><robot/>", "<sdformat/>", "<", "<!--", "sdf"}) {
        EXPECT_FALSE(reader->recognises(text)) << text;
    }
}

TEST(ReadSdf, ReadsAModelOfGazebo) {
    const std::filesystem::path file = shared_folder() / "reference_formats/sdformat/shapes.sdf";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "there is no " << file;
    }
    const SphereFile read = sdf.file(contents(file));
    ASSERT_EQ(read.links.size(), 1U);
    EXPECT_EQ(read.links[0].link, "link");
    EXPECT_EQ(read.links[0].elements.spheres(), (std::vector<Sphere>{{{0, 0, 0}, 23.4}}));
    EXPECT_GE(read.links[0].elements.shaped().size(), 3U); // box, capsule, cylinder
    EXPECT_THAT(read.notes.at(0), HasSubstr("no convex element (cone"));
}

} // namespace
} // namespace foam::test
