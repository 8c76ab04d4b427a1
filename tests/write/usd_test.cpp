// write.usd and read.usd.
#include "plugin_stages.hpp"
#include "support/read_spheres.hpp"

#include <gmock/gmock.h>

namespace foam::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const Format usd{"write_usd", "write.usd", "read.usd"};

SphereModel with_pair() {
    SphereModel model = turned_model();
    model.ignored_pairs = {{"base", "tool", "Adjacent"}, {"tool", "camera", "Never"}};
    return model;
}

TEST(WriteUsd, WritesAnOverlay) {
    const std::string text = usd.text(turned_model(), {{"sublayer", "./arm.usd"}, {"inactive", "collisions"}});
    EXPECT_THAT(text,
                StartsWith("#usda 1.0\n# foam 1; part.urdf -- proved\n(\n    subLayers = [@./arm.usd@]\n"
                           "    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n\nover \"chain\"\n{\n    over \"base\"\n"));
    EXPECT_THAT(text, HasSubstr("over \"collisions\" (\n            active = false\n"));
    EXPECT_THAT(text, HasSubstr("prepend apiSchemas = [\"PhysicsCollisionAPI\"]"));
    EXPECT_THAT(text, HasSubstr("double radius = 0.25\n"));
    EXPECT_THAT(text, HasSubstr("float3[] extent = [(-0.25, -0.25, -0.25), (0.25, 0.25, 0.25)]\n"));
    EXPECT_THAT(text, HasSubstr("double3 xformOp:translate = (0.1, 0.2, 0.3)\n"));
    EXPECT_THAT(text, HasSubstr("uniform token[] xformOpOrder = [\"xformOp:translate\"]\n"));
}

TEST(WriteUsd, FiltersPairsOfLinksWithSpheresOnDemand) {
    EXPECT_THAT(usd.text(with_pair()), HasSubstr("rel physics:filteredPairs = [</chain/tool>]\n"));
    EXPECT_THAT(usd.text(with_pair()), Not(HasSubstr("camera")));
    EXPECT_THAT(usd.text(with_pair(), {{"pairs", false}}), Not(HasSubstr("Filtered")));
}

TEST(WriteUsd, NamesOfPrimsAreIdentifiersAndDiffer) {
    const auto ball = [](const std::string& link) { return group_of(link, {}, flat_tree({{{0, 0, 0}, 1}})); };
    const SphereModel model = model_of(nullptr, {ball("a-b"), ball("a_b"), ball("a.b"), ball("1"), ball("a_b_2")});
    const std::string text = usd.text(model);
    for (const char* name : {"\"a_b\"", "\"a_b_2\"", "\"a_b_3\"", "\"a_b_4\"", "\"_\""}) {
        EXPECT_THAT(text, HasSubstr(std::string("    over ") + name)) << name;
    }
    // The link that is an identifier keeps its name.
    EXPECT_THAT(text, HasSubstr("over \"a_b\"\n    {\n        def Scope \"foam_spheres\"\n        {\n"
                                "            custom string foam:link = \"a_b\"\n"));
    EXPECT_EQ(read_spheres(*writer("write_usd", "write.usd"), text), spheres_of(model));
}

TEST(WriteUsd, PathsFollowThePattern) {
    const std::string text = usd.text(with_pair(), {{"prim", "/World/{robot}/{link}/body_{link}"}});
    EXPECT_THAT(text, HasSubstr("</World/chain/tool/body_tool>"));
    EXPECT_THAT(text, HasSubstr("over \"World\"\n{\n    over \"chain\"\n    {\n        over \"base\"\n        {\n"
                                "            over \"body_base\" (\n"));
    EXPECT_EQ(read_spheres(*writer("write_usd", "write.usd"), text), spheres_of(with_pair()));
    for (const char* pattern :
         {"", "/", "a/{link}", "/a//{link}", "/{link}/", "/{name}/{link}", "/1/{link}", "/a", "/a b/{link}"}) {
        EXPECT_THAT(refusal(*writer("write_usd", "write.usd", {{"prim", pattern}}), with_pair()), HasSubstr("remedy"))
            << pattern;
    }
    EXPECT_THAT(refusal(*writer("write_usd", "write.usd", {{"sublayer", "a@b"}}), with_pair()), HasSubstr("remedy"));
    EXPECT_THAT(refusal(*writer("write_usd", "write.usd", {{"inactive", "a/b"}}), with_pair()), HasSubstr("remedy"));
}

TEST(WriteUsd, OneLinkNeedsNoPlaceInThePattern) {
    const SphereModel model = model_of(nullptr, {group_of("a", {}, flat_tree({{{0, 0, 0}, 1}}))});
    const std::string text = usd.text(model, {{"prim", "/ball"}});
    EXPECT_THAT(text, HasSubstr("\nover \"ball\"\n{\n    def Scope"));
    EXPECT_EQ(read_spheres(*writer("write_usd", "write.usd"), text), spheres_of(model));
}

TEST(WriteUsd, HostileNames) {
    usd.expect_hostile_names(false);
}

TEST(ReadUsd, SaysWhatIsWrongAndWhere) {
    const std::string begin = "#usda 1.0\ndef Scope \"s\" {\ncustom string foam:link = \"a\"\ndef Sphere \"s0\" {\n";
    EXPECT_EQ(usd.message(begin + "double radius = inf\n}}"), "FILE:5: expected a finite number, got 'inf'");
    EXPECT_THAT(usd.message(begin + "double radius = 1\ndouble3 xformOp:scale = (1, 2, 3)\n}}"),
                HasSubstr("FILE:7: the sphere 's0' is turned or scaled"));
    EXPECT_THAT(usd.message(begin + "}}"), HasSubstr("has no radius"));
    EXPECT_THAT(usd.message(begin + "double radius = 1"), HasSubstr("ends within the prim 's0'"));
    EXPECT_THAT(usd.message(begin + "double3 xformOp:translate = (1, 2)\n"), HasSubstr("three numbers"));
    EXPECT_THAT(usd.message("#usda 1.0\ndef \"" + std::string(1000, 'a')), StartsWith("FILE:2: "));
    std::string deep = "#usda 1.0\n";
    for (int i = 0; i < 50'000; ++i) {
        deep += "def \"a\" {";
    }
    EXPECT_THAT(usd.message(deep), HasSubstr("ends within the prim"));
    EXPECT_THAT(usd.message("#usda 1.0\n" + std::string(100'000, '(')), HasSubstr("ends within brackets"));
    usd.expect_truncations(usd.text(with_pair()));
}

TEST(ReadUsd, RecognisesLayersOnly) {
    const auto reader = usd.reader();
    const std::string text = usd.text(turned_model());
    EXPECT_TRUE(reader->recognises(text));
    EXPECT_TRUE(reader->recognises(text.substr(text.find('(')))); // as it is without comments
    for (const char* other : {"(a b c)\n", "define x\n", "over the hills\n", "[1, 2]"}) {
        EXPECT_FALSE(reader->recognises(other)) << other;
    }
}

TEST(ReadUsd, RefusesLayersOfOthersWithARemedy) {
    const std::filesystem::path file = shared_folder() / "reference_formats/usd/sensor_contact_scene.usda";
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "there is no " << file;
    }
    EXPECT_TRUE(usd.reader()->recognises(contents(file)));
    EXPECT_THAT(usd.message(contents(file)), HasSubstr("only layers of write.usd are read"));
}

} // namespace
} // namespace foam::test
