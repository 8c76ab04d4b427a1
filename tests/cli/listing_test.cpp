// stages, describe, plugins, schema, version.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace foam::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST_F(Cli, StagesForPeopleAndPrograms) {
    const Outcome text = foam("stages"), data = foam("stages --json");
    EXPECT_EQ(text.code, 0);
    EXPECT_EQ(text.err, "");
    const json stages = json::parse(data.out);
    ASSERT_GT(stages.size(), 5u);
    for (const json& stage : stages) {
        EXPECT_THAT(text.out, HasSubstr(stage["name"].get<std::string>()));
        EXPECT_FALSE(stage["summary"].get<std::string>().empty());
        for (const json& parameter : stage["parameters"]) {
            EXPECT_TRUE(parameter.contains("default") && parameter.contains("doc")) << parameter;
        }
    }
}

TEST_F(Cli, DescribeAStage) {
    const Outcome text = foam("describe load.mesh");
    EXPECT_EQ(text.code, 0);
    EXPECT_THAT(text.out, HasSubstr("load.mesh (mesh loader, plugin load_mesh "));
    EXPECT_THAT(text.out, HasSubstr("max_triangles: 20000000    # integer 1 … 1e+09"));
    const json data = json::parse(foam("describe load.mesh --json").out);
    EXPECT_EQ(data["name"], "load.mesh");
    EXPECT_EQ(data["parameters"][0]["default"], 20'000'000);
}

TEST_F(Cli, DescribeSaysWhatASpherizerDeclares) {
    const Outcome text = foam("describe spherize.cover");
    EXPECT_THAT(text.out, HasSubstr("\n"
                                    "Uses only the original geometry: mesh filters before it have no effect.\n"
                                    "Objective: parameter objective.\n"));
    const json data = json::parse(foam("describe spherize.cover --json").out);
    EXPECT_EQ(data["original_only"], true);
    EXPECT_EQ(data["objective_parameter"], "objective");
    EXPECT_EQ(json::parse(foam("describe spherize.grid --json").out)["objective_parameter"], "");
}

TEST_F(Cli, DescribeAnUnknownStage) {
    const Outcome outcome = foam("describe load.mesch");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "foam: error: unknown stage 'load.mesch'; did you mean 'load.mesh'?\n");
}

TEST_F(Cli, PluginsAndWhyOneIsRefused) {
    std::filesystem::create_directory(path() / "mine");
    write("mine/bad.so", "no library at all");
    const Outcome brief = foam("plugins --plugin-dir mine");
    EXPECT_EQ(brief.code, 0);
    EXPECT_THAT(brief.out, HasSubstr("load_mesh"));
    EXPECT_EQ(brief.err, "foam: 1 more refused; `foam plugins --why` shows why\n");
    const Outcome why = foam("plugins --plugin-dir mine --why");
    EXPECT_EQ(why.code, 0);
    EXPECT_THAT(why.out, HasSubstr("mine/bad.so\n  refused: it is no shared library (it has no ELF header); remedy: "
                                   "build it with foam_add_plugin()\n"));
    const json data = json::parse(foam("plugins --plugin-dir mine --json").out);
    EXPECT_FALSE(data[0]["loaded"].get<bool>());
    EXPECT_EQ(data[0]["rejection"],
              "it is no shared library (it has no ELF header); remedy: build it with foam_add_plugin()");
}

TEST_F(Cli, ARefusedPluginIsWarnedOfAndOneAskedForIsAnError) {
    std::filesystem::create_directory(path() / "mine");
    write("mine/bad.so", "no library at all");
    const Outcome folder = foam("stages --plugin-dir mine");
    EXPECT_EQ(folder.code, 0);
    EXPECT_THAT(folder.err, HasSubstr("foam: warning: plugin "));
    const Outcome file = foam("stages --plugin mine/bad.so");
    EXPECT_EQ(file.code, 3);
    EXPECT_EQ(file.out, "");
    EXPECT_THAT(file.err, HasSubstr("mine/bad.so is refused: it is no shared library (it has no ELF header); remedy: "
                                    "build it with foam_add_plugin()\n"));
    EXPECT_EQ(foam("stages --plugin mine/none.so").code, 3);
}

TEST_F(Cli, SchemaIsJson) {
    const Outcome outcome = foam("schema");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(json::parse(outcome.out).contains("$schema"));
}

TEST_F(Cli, VersionSaysTheAbiAndLibraries) {
    const json data = json::parse(foam("version --json").out);
    EXPECT_THAT(data["abi"].get<std::string>(), HasSubstr("foam-abi="));
    for (const char* library : {"eigen", "fmt", "yaml-cpp", "onetbb"}) {
        EXPECT_FALSE(data["libraries"].at(library).get<std::string>().empty()) << library;
    }
    EXPECT_THAT(foam("version").out, HasSubstr("yaml-cpp"));
    write("box.obj", box_obj);
    ASSERT_EQ(foam("spherize box.obj -n 2 -m grid --run-dir made -q").code, 0);
    const json manifest = json::parse(contents(path() / "made/manifest.json"));
    for (const char* name : {"foam_version", "foam_build"}) {
        EXPECT_EQ(data.at(name), manifest.at(name));
    }
}

} // namespace
} // namespace foam::test
