// write.moveit_scene, write.markers and their readers.
#include "plugin_stages.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const Format scene{"write_scene", "write.moveit_scene", "read.moveit_scene"};
const Format markers{"write_scene", "write.markers", "read.markers"};

SphereModel ball() {
    return model_of(chain_of({"ball"}), {group_of("ball", {}, flat_tree({{{1, 2, 0.1}, 0.5}}))});
}

TEST(WriteScene, WritesAnObjectALink) {
    EXPECT_EQ(scene.text(ball()), "test\n* ball\n0 0 0\n0 0 0 1\n1\nsphere\n0.5\n1 2 0.1\n0 0 0 1\n0 0 0 0\n0\n.\n");
    EXPECT_EQ(scene.text(ball(), {{"version", "old"}}), "test\n* ball\n1\nsphere\n0.5\n1 2 0.1\n0 0 0 1\n0 0 0 0\n.\n");
}

TEST(WriteScene, PlacesLinksAndKeepsTheirFrames) {
    const std::string text = scene.text(turned_model());
    EXPECT_THAT(text, HasSubstr("* tool\n0 0 1\n0.707106781186547"));
    EXPECT_EQ(read_spheres(*writer("write_scene", "write.moveit_scene"), text), spheres_of(turned_model()));
    EXPECT_THAT(refusal(*writer("write_scene", "write.moveit_scene", {{"version", "old"}}), turned_model()),
                HasSubstr("remedy: version: new"));
}

TEST(WriteScene, HostileNames) {
    scene.expect_hostile_names(false);
    markers.expect_hostile_names(false);
}

TEST(ReadScene, DecidesTheFormatByTheLineAfterTheObject) {
    EXPECT_EQ(scene.file("s\n* a\n1\nsphere 0.5 1 2 3 0 0 0 1 0 0 0 0 .\n").format, "MoveIt scene (old)");
    const SphereFile with_pose = scene.file("s\n\n* a b \n1 0 0\n0 0 0 1\n1\nsphere 0.5 1 2 3 0 0 0 1 0 0 0 0\n0\n.");
    EXPECT_EQ(with_pose.format, "MoveIt scene");
    ASSERT_EQ(with_pose.links.size(), 1U);
    EXPECT_EQ(with_pose.links[0].link, "a b");
    EXPECT_EQ(with_pose.links[0].elements.spheres(), (std::vector<Sphere>{{{1, 2, 3}, 0.5}}));
}

TEST(ReadScene, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(scene.message("s\n* a\n1\nsphere\nbig\n"), "FILE:5: 'big' is not a finite number; expected is a radius");
    EXPECT_EQ(scene.message("s\n* a\n1\nsphere\ninf\n"), "FILE:5: 'inf' is not a finite number; expected is a radius");
    EXPECT_EQ(scene.message("s\n* a\n1\nteapot\n"), "FILE:4: unknown shape 'teapot'");
    EXPECT_EQ(scene.message("s\n* a\n-1\n.\n"), "FILE:3: '-1' is not a count; expected is the number of shapes");
    EXPECT_THAT(scene.message("s\n* a\n4000000000\n"), HasSubstr("the file ends"));
    EXPECT_THAT(scene.message("s\n* a\n1\nmesh 4294967295 4294967295 0\n"), HasSubstr("the file ends"));
    EXPECT_THAT(scene.message("s\n* a\n0\n"), HasSubstr("'.' at the end"));
    scene.expect_truncations(scene.text(turned_model()));
}

TEST(ReadScene, RecognisesItsOwnOnly) {
    const auto reader = scene.reader();
    EXPECT_TRUE(reader->recognises(scene.text(ball())));
    EXPECT_TRUE(reader->recognises("* ball\n1\n")); // a blank name is not part of the text
    for (const char* text :
         {"* a list\n* of words\n", "a: b\n* c\nd\n", "# x\n", "0 0 0 1\n", "l 0 0 0 1\n0 0 0 0 1\n"}) {
        EXPECT_FALSE(reader->recognises(text)) << text;
    }
}

TEST(ReadScene, ReadsTheScenesOfMoveIt) {
    const std::filesystem::path folder = shared_folder() / "reference_formats/moveit_scene";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "there is no " << folder;
    }
    for (const auto& [file, format] :
         {std::pair("old_format.scene", "MoveIt scene (old)"), {"new_format.scene", "MoveIt scene"}}) {
        const std::string text = contents(folder / file);
        EXPECT_TRUE(scene.reader()->recognises(text));
        const SphereFile read = scene.file(text);
        EXPECT_EQ(read.format, format);
        ASSERT_FALSE(read.links.empty());
        EXPECT_EQ(read.links.at(0).elements.shaped()[0].kind, Element::Kind::box);
    }
}

TEST(WriteMarkers, ScaleIsTheDiameterAndNothingIsInvisible) {
    const std::string text = markers.text(turned_model());
    EXPECT_THAT(text, StartsWith("# foam 1; part.urdf -- proved\nmarkers:\n"));
    EXPECT_THAT(text, HasSubstr("header: {frame_id: tool}\n    ns: tool\n    id: 0\n    type: 2\n    action: 0\n"));
    EXPECT_THAT(text, HasSubstr("scale: {x: 0.5, \"y\": 0.5, z: 0.5}"));
    EXPECT_THAT(text, HasSubstr("a: 0.6}\n    frame_locked: true\n"));
    EXPECT_EQ(read_spheres(*writer("write_scene", "write.markers"), text), spheres_of(turned_model()));
}

TEST(WriteMarkers, RefusesADiameterThatNoDoubleHolds) {
    const SphereModel model = model_of(nullptr, {group_of("a", {}, flat_tree({{{0, 0, 0}, 1e308}}))});
    EXPECT_THAT(refusal(*writer("write_scene", "write.markers"), model), HasSubstr("remedy"));
}

TEST(ReadMarkers, LeavesOutWhatIsNoSphere) {
    const std::string rest = "header: {frame_id: a}, pose: {position: {x: 1, y: 2, z: 3}}, ";
    const SphereFile read =
        markers.file("markers:\n- {type: 2, " + rest + "scale: {x: 1, y: 1, z: 1}}\n- {type: 3, " + rest +
                     "scale: {x: 1, y: 2, z: 1}}\n- {type: 7, " + rest + "scale: {x: 1, y: 1, z: 1}}\n");
    ASSERT_EQ(read.links.size(), 1U);
    EXPECT_EQ(read.links[0].elements.spheres(), (std::vector<Sphere>{{{1, 2, 3}, 0.5}}));
    EXPECT_EQ(read.notes, std::vector<std::string>{"2 markers are no single convex elements, and left out"});
}

TEST(ReadMarkers, ASphereOfThreeDiametersIsAnEllipsoid) {
    const SphereFile read =
        markers.file("markers:\n- {type: 2, header: {frame_id: a}, pose: {position: {x: 1, y: 2, z: 3}, orientation: "
                     "{x: 0, y: 0, z: 1, w: 0}}, scale: {x: 1, y: 2, z: 4}}\n");
    ASSERT_EQ(read.links.size(), 1U);
    EXPECT_TRUE(read.links[0].elements.spheres().empty());
    ASSERT_EQ(read.links[0].elements.shaped().size(), 1U);
    const Element& element = read.links[0].elements.shaped()[0];
    EXPECT_EQ(element.kind, Element::Kind::ellipsoid);
    EXPECT_EQ(element.half, Vec3(0.5, 1, 2));
    EXPECT_EQ(element.pose.translation, Vec3(1, 2, 3));
    EXPECT_EQ(element.pose.rotation[0], Vec3(-1, 0, 0));
    EXPECT_TRUE(is_valid(element));
}

TEST(ReadMarkers, LeavesOutTrianglesThatAreNoConvexSurface) {
    const auto listed = [](const std::vector<std::array<int, 3>>& triangles) {
        const std::array<const char*, 4> corners{"{x: 0, y: 0, z: 0}", "{x: 1, y: 0, z: 0}", "{x: 0, y: 1, z: 0}",
                                                 "{x: 0, y: 0, z: 1}"};
        std::string points;
        for (const std::array<int, 3>& triangle : triangles) {
            for (const int corner : triangle) {
                points += std::string(points.empty() ? "" : ", ") + corners.at(static_cast<std::size_t>(corner));
            }
        }
        return "markers:\n- {type: 11, header: {frame_id: a}, pose: {position: {x: 1, y: 2, z: 3}}, "
               "scale: {x: 1, y: 1, z: 1}, points: [" +
               points + "]}\n";
    };
    const SphereFile whole = markers.file(listed({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
    ASSERT_EQ(whole.links.size(), 1U);
    EXPECT_EQ(whole.links[0].elements.shaped().size(), 1U);
    // A face is missing: all corners are there, but the triangles enclose nothing.
    const SphereFile open = markers.file(listed({{0, 2, 1}, {0, 1, 3}, {1, 2, 3}}));
    EXPECT_TRUE(open.links.empty());
    EXPECT_EQ(open.notes, std::vector<std::string>{"1 marker is no single convex element, and left out"});
}

TEST(ReadMarkers, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(markers.message("markers: 1\n"), "FILE:1:10: expected a list of markers, got 1");
    EXPECT_THAT(markers.message("markers: [{type: .nan, scale: {x: 1, y: 1, z: 1}}]\n"), HasSubstr("finite number"));
    EXPECT_THAT(markers.message("markers: [[[[[["), StartsWith("FILE"));
    EXPECT_THAT(markers.message("markers: " + std::string(100'000, '[')), StartsWith("FILE"));
    markers.expect_truncations(markers.text(ball()));
}

TEST(ReadMarkers, RecognisesItsOwnOnly) {
    const auto reader = markers.reader();
    EXPECT_TRUE(reader->recognises(markers.text(ball())));
    EXPECT_TRUE(reader->recognises("{\"markers\": [{\"header\": {\"frame_id\": \"a\"}}]}"));
    for (const char* text : {"markers: {centers: [[0, 0, 0]], radii: [1]}\n", "links: {markers: 1}\nframe_id: a\n",
                             "{\"a\": {\"markers\": \"frame_id\"}}"}) {
        EXPECT_FALSE(reader->recognises(text)) << text;
    }
}

} // namespace
} // namespace foam::test
