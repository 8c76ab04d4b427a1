// The layouts of write.json.
#include "models.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <support/temporary_folder.hpp>

#include <cstdlib>
#include <fstream>

namespace foam::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json written(const SphereModel& model, const std::string& layout) {
    QuietContext context;
    return json::parse(writer("write_json", "write.json", {{"layout", layout}})->write(model, context));
}

TEST(WriteJson, HoldsAllOfTheModel) {
    SphereModel model = awkward_model();
    model.verdict.with_geometry = model.verdict.proved = 2;
    const json document = written(model, "links");
    EXPECT_EQ(document["foam_spheres"], 1);
    EXPECT_EQ(document["name"], "test");
    EXPECT_EQ(document["robot"], "chain");
    EXPECT_EQ(document["guarantee"], "outer");
    EXPECT_EQ(document["certified"], true);
    const json& link = document["links"]["second"];
    EXPECT_EQ(link["spheres"].size(), 4u);
    ASSERT_EQ(link["groups"].size(), 1u);
    const json& group = link["groups"][0];
    EXPECT_EQ(group["geometries"], (json{"box", "a.stl"}));
    EXPECT_EQ(group["measures"]["excess"], 0.25);
    const SphereTree& tree = model.groups[2].tree;
    ASSERT_EQ(group["levels"].size(), tree.levels.size());
    for (std::size_t l = 0; l < tree.levels.size(); ++l) {
        for (std::size_t i = 0; i < tree.levels[l].elements.spheres().size(); ++i) {
            const json& sphere = group["levels"][l][i];
            EXPECT_EQ(sphere["center"][2], tree.levels[l].elements.spheres()[i].center.z);
            EXPECT_EQ(sphere["radius"], tree.levels[l].elements.spheres()[i].radius);
            EXPECT_EQ(sphere.contains("parent"), l > 0);
            if (l > 0) {
                EXPECT_EQ(sphere["parent"], tree.levels[l].parents[i]);
            }
        }
    }
    EXPECT_EQ(document["links"].begin().value()["groups"].size(), 2u);
}

TEST(WriteJson, SaysWhatTheVerdictSays) {
    SphereModel model = awkward_model();
    EXPECT_EQ(written(model, "links")["certified"], false) << "nothing is known of it";
    EXPECT_FALSE(written(model, "links").contains("covers"));
    model.verdict.with_geometry = model.verdict.proved = 2;
    EXPECT_EQ(written(model, "links")["covers"], "solid");
    EXPECT_FALSE(written(model, "links").contains("missing"));
    model.verdict.missing = 0.25;
    model.verdict.as_surface = {{"first, \"link\" & <more>", "its mesh is open"}};
    EXPECT_EQ(written(model, "links")["certified"], true);
    EXPECT_EQ(written(model, "links")["covers"], "surface");
    EXPECT_EQ(written(model, "links")["surface_links"], json::array({"first, \"link\" & <more>"}));
    EXPECT_EQ(written(model, "links")["missing"], 0.25);
    model.verdict.missing = NAN;
    EXPECT_TRUE(written(model, "links")["missing"].is_null()) << "there was no time to measure it";
    model.verdict.proved = 1;
    EXPECT_EQ(written(model, "links")["certified"], false);
}

TEST(WriteJson, UnknownFiguresAreNull) {
    SphereModel model = awkward_model();
    model.groups[2].measures.excess = NAN;
    model.groups[2].measures.gap = INFINITY;
    model.groups[2].measures.certified = false;
    const json document = written(model, "links");
    EXPECT_TRUE(document["links"]["second"]["groups"][0]["measures"]["excess"].is_null());
    EXPECT_TRUE(document["links"]["second"]["groups"][0]["measures"]["gap_m"].is_null());
    EXPECT_EQ(document["certified"], false);
}

TEST(WriteJson, OriginalLayoutHasAnEntryForEveryDepth) {
    SphereModel model = awkward_model();
    model.groups[2].measures.protrusion_max = 0.5;
    const json document = written(model, "foam");
    ASSERT_EQ(document.size(), 3u) << "the second group of the same mesh must not overwrite the first";
    EXPECT_TRUE(document.contains("first, \"link\" & <more>::b.stl#2"));
    const json& depths = document["second::box+a.stl"]["2"];
    ASSERT_EQ(depths.size(), 3u);
    EXPECT_EQ(depths["0"]["spheres"].size(), 1u);
    EXPECT_EQ(depths["2"]["spheres"].size(), 4u);
    EXPECT_EQ(depths["2"]["worst"], 0.5);
    EXPECT_TRUE(depths["1"]["worst"].is_null());
    EXPECT_EQ(depths["2"]["spheres"][0]["origin"], (json{0.1, -0.2, 1.0 / 3}));
}

TEST(WriteJson, OriginalLayoutOfAMeshIsAList) {
    SphereModel model = awkward_model();
    model.groups.erase(model.groups.begin(), model.groups.begin() + 2);
    const json document = written(model, "foam_mesh");
    ASSERT_TRUE(document.is_array());
    EXPECT_EQ(document.size(), 3u);
    EXPECT_EQ(document[2]["spheres"].size(), 4u);
    EXPECT_THAT(refusal(*writer("write_json", "write.json", {{"layout", "foam_mesh"}}), awkward_model()),
                HasSubstr("holds one mesh, and the model has 3 groups"));
}

/// Exit status of the Python validator on the document: 0 valid, 1 not valid, 77 there is no validator.
int validate(const std::string& document) {
    TemporaryFolder folder;
    std::ofstream(folder.path() / "document.json") << document;
    const std::string command = "python3 -c \"\nimport json, sys\ntry:\n  import jsonschema\n  v = "
                                "jsonschema.Draft202012Validator\nexcept Exception:\n"
                                "  sys.exit(77)\ns = json.load(open('" FOAM_TEST_SOURCE
                                "/schemas/spheres.schema.json'))\nv.check_schema(s)\n"
                                "errors = list(v(s).iter_errors(json.load(open('" +
                                (folder.path() / "document.json").string() +
                                "'))))\n[print(e) for e in errors]\nsys.exit(1 if errors else 0)\"";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 77;
}

TEST(WriteJson, FollowsTheSchema) {
    SphereModel model = awkward_model();
    model.groups[0].measures.gap = INFINITY;
    json document = written(model, "links");
    const int valid = validate(document.dump());
    if (valid == 77 || valid == 127) {
        GTEST_SKIP() << "python3-jsonschema is not installed";
    }
    EXPECT_EQ(valid, 0);
    document["links"]["second"]["spheres"][0][3] = 0;
    EXPECT_EQ(validate(document.dump()), 1) << "a radius of 0 must not pass";
}

} // namespace
} // namespace foam::test
