// The JSON Schema of recipes.
#include "support.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <set>

namespace foam::test {
namespace {

using Json = nlohmann::json;

/// Every "$ref" in the schema.
void collect_references(const Json& node, std::set<std::string>& references) {
    if (node.is_object() && node.contains("$ref")) {
        references.insert(node["$ref"].get<std::string>());
    }
    if (node.is_structured()) {
        for (const Json& child : node) {
            collect_references(child, references);
        }
    }
}

TEST(RecipeSchema, HoldsEveryParameterAsDeclared) {
    Registry registry;
    load_fixtures(registry);
    const Json schema = Json::parse(recipe_schema(registry));
    EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    for (const auto& [name, stage] : registry.stages()) {
        ASSERT_TRUE(schema["$defs"].contains(name)) << name;
        const Json& properties = schema["$defs"][name]["properties"];
        for (const Parameter& p : stage.info.parameters) {
            ASSERT_TRUE(properties.contains(p.name)) << name << " " << p.name;
            const Json& property = properties[p.name];
            EXPECT_NE(property["description"].get<std::string>().find(p.doc_text), std::string::npos);
            EXPECT_TRUE(property.contains("default"));
            EXPECT_EQ(p.low ? property.contains("minimum") : false, p.low.has_value());
            EXPECT_EQ(p.high ? property.contains("maximum") : false, p.high.has_value());
        }
    }
    const Json& ratio = schema["$defs"]["simplify.fixture"]["properties"]["ratio"];
    EXPECT_EQ(ratio, Json::parse(R"({"description": "Share kept. Default from: Coumar 2025.", "type": "number",
                                     "minimum": 0, "maximum": 1, "default": 0.2})"));
    const Json& step = schema["$defs"]["smooth.fixture"]["properties"]["step"];
    EXPECT_EQ(step["description"], "Step. Unit: m, or as a text with another: 10mm, 1cm, 0.4in.");
    EXPECT_EQ(step["type"], Json::parse(R"(["number", "string"])"));
    const Json& mode = schema["$defs"]["simplify.fixture"]["properties"]["mode"];
    EXPECT_EQ(mode["enum"], Json::parse(R"(["fast", "exact"])"));
}

TEST(RecipeSchema, EveryReferenceLeadsSomewhere) {
    Registry registry;
    load_fixtures(registry);
    const Json schema = Json::parse(recipe_schema(registry));
    std::set<std::string> references;
    collect_references(schema, references);
    EXPECT_GE(references.size(), registry.stages().size() - 1); // all but the loader's
    for (const std::string& reference : references) {
        const std::string prefix = "#/$defs/";
        ASSERT_EQ(reference.substr(0, prefix.size()), prefix);
        EXPECT_TRUE(schema["$defs"].contains(reference.substr(prefix.size()))) << reference;
    }
}

/// schemas/recipe.schema.json is for editors; it must say what the program says. FOAM_TEST_UPDATE=1 writes it anew.
TEST(RecipeSchema, TheCommittedOneIsThatOfTheseStages) {
    const std::filesystem::path file = std::filesystem::path(FOAM_TEST_SOURCE) / "schemas/recipe.schema.json";
    Registry registry;
    registry.load_directory(FOAM_TEST_PLUGINS);
    if (std::getenv("FOAM_TEST_UPDATE")) {
        std::ofstream(file, std::ios::binary) << recipe_schema(registry);
    }
    const Json committed = Json::parse(read_file(file), nullptr, false);
    ASSERT_TRUE(committed.is_object()) << file << " is no JSON object";
    const Json definitions = committed.value("$defs", Json::object());
    for (const auto& [name, unused] : definitions.items()) {
        const bool changed = name.starts_with("changed "); // of a recipe that extends another
        if (name.find('.') != std::string::npos && !changed && !registry.find(name)) {
            GTEST_SKIP() << "this build has no stage " << name;
        }
    }
    EXPECT_EQ(read_file(file), recipe_schema(registry)) << "remedy: FOAM_TEST_UPDATE=1 recipe_schema";
}

TEST(RecipeSchema, IsValidWithoutAnyStage) {
    const Registry registry;
    EXPECT_TRUE(Json::parse(recipe_schema(registry)).contains("$defs"));
}

} // namespace
} // namespace foam::test
