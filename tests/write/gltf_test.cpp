// write.gltf and read.gltf.
#include "plugin_stages.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const Format gltf{"write_gltf", "write.gltf", "read.gltf"};

TEST(WriteGltf, NodesHoldTheSpheres) {
    const std::string text = gltf.text(turned_model());
    EXPECT_THAT(text, HasSubstr("pictures only"));
    EXPECT_THAT(text, HasSubstr("\"translation\": [0.1, 0.2, 0.3]"));
    EXPECT_THAT(text, HasSubstr("\"scale\": [0.25, 0.25, 0.25]"));
    EXPECT_THAT(text, HasSubstr("\"radius\": 0.25"));
    EXPECT_EQ(read_spheres(*writer("write_gltf", "write.gltf"), text), spheres_of(turned_model()));
}

TEST(WriteGltf, RobotsStandUprightAndLinksAtTheDefaultPose) {
    const std::string text = gltf.text(turned_model());
    EXPECT_THAT(text, HasSubstr("\"rotation\": [-0.7071067811865476, 0.0, 0.0, 0.7071067811865476]"));
    EXPECT_THAT(text, HasSubstr("0.0, 0.0, 1.0, 1.0]")); // the last column of the tool's matrix: 1 m up
}

TEST(WriteGltf, HostileNames) {
    gltf.expect_hostile_names(false);
}

TEST(ReadGltf, SaysWhatIsWrongAndWhere) {
    EXPECT_EQ(gltf.message("{\"asset\": 1}"), "FILE:1:1: expected a list 'nodes'");
    EXPECT_THAT(gltf.message(R"({"nodes": [{"children": [7]}]})"), HasSubstr("expected the number of a node, 0 to 0"));
    EXPECT_THAT(gltf.message(R"({"nodes": [{"children": [-1]}]})"), HasSubstr("expected the number of a node"));
    EXPECT_THAT(gltf.message(R"({"nodes": [{}]})"), HasSubstr("remedy"));
    EXPECT_THAT(gltf.message(R"({"nodes": [{"children": [1]}, {"extras": {"radius": 1e999}}]})"),
                HasSubstr("finite number"));
    EXPECT_THAT(gltf.message("{\"nodes\": " + std::string(100'000, '[')), StartsWith("FILE"));
    gltf.expect_truncations(
        R"({"asset": {}, "nodes": [{"children": [1]}, {"translation": [0, 1, 2], "extras": {"radius": 1}}]})");
}

TEST(ReadGltf, RecognisesItsOwnOnly) {
    EXPECT_TRUE(gltf.reader()->recognises(gltf.text(turned_model())));
    EXPECT_FALSE(gltf.reader()->recognises(R"({"asset": {"centers": [[0, 0, 0]], "radii": [1]}})"));
}

} // namespace
} // namespace foam::test
