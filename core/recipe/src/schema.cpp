// JSON Schema of recipes: for editors and for checks by other tools.
#include "format.hpp"

#include <foam/geometry/length.hpp>
#include <foam/recipe/internal/keys.hpp>
#include <foam/recipe/recipe.hpp>
#include <foam/sdk/internal/declaration.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace foam::inline recipe {
namespace {

using Json = nlohmann::ordered_json;
using namespace reading;

constexpr const char* folder_name = "^(?![-.])[A-Za-z0-9_.+=-]{1,200}$";

Json as_json(const ParameterValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

/// Returns a bound without a fraction as an integer.
Json as_json(double bound) {
    constexpr double exact = 9007199254740992.0; // 2^53
    const bool whole =
        bound >= -exact && bound <= exact && bound == static_cast<double>(static_cast<std::int64_t>(bound));
    return whole ? Json(static_cast<std::int64_t>(bound)) : Json(bound);
}

std::string describe(const Parameter& p) {
    std::string text = p.doc_text;
    if (!p.unit_text.empty() && p.unit_text != "1") {
        text += " Unit: " + p.unit_text + (is_length(p) ? ", or as a text with another: 10mm, 1cm, 0.4in." : ".");
    }
    return p.source_text.empty() ? text : text + " Default from: " + p.source_text + ".";
}

/// Returns a pattern for the text of a length with a unit. Only foam checks its bounds.
std::string length_pattern(const Parameter& p) {
    return fmt::format("^{}([0-9]+([.][0-9]*)?|[.][0-9]+)([eE][-+]?[0-9]+)? ?({})$",
                       p.low && *p.low >= 0 ? "[+]?" : "[-+]?", fmt::join(length_units(), "|"));
}

Json schema_of(const Parameter& p) {
    Json schema;
    schema["description"] = describe(p);
    switch (p.type) {
    case Parameter::Type::boolean:
        schema["type"] = "boolean";
        break;
    case Parameter::Type::integer:
        schema["type"] = "integer";
        schema["minimum"] = std::numeric_limits<std::int64_t>::min();
        schema["maximum"] = std::numeric_limits<std::int64_t>::max();
        break;
    case Parameter::Type::number:
        schema["type"] = "number";
        if (is_length(p)) {
            schema["type"] = {"number", "string"};
            schema["pattern"] = length_pattern(p);
        }
        break;
    case Parameter::Type::text:
        schema["type"] = "string";
        break;
    case Parameter::Type::choice:
        schema["enum"] = p.choices;
        break;
    }
    if (p.low) {
        schema["minimum"] = as_json(*p.low);
    }
    if (p.high) {
        schema["maximum"] = as_json(*p.high);
    }
    if (!is_optional(p.name)) {
        schema["default"] = as_json(p.default_value);
    }
    return schema;
}

Json object(Json properties) {
    return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
}

Json properties_of(const std::vector<Parameter>& parameters) {
    Json properties = Json::object();
    for (const Parameter& p : parameters) {
        properties[p.name] = schema_of(p);
    }
    return properties;
}

Json reference(const std::string& definition) {
    return {{"$ref", "#/$defs/" + definition}};
}

void add_isolation(Json& properties) {
    for (const Parameter& p : isolation_values()) {
        properties[p.name] = reference(p.name);
    }
}

/// Returns the schema of a stage's parameters; null means none.
Json parameters_of(const RegisteredStage& stage) {
    Json properties = properties_of(stage.info.parameters);
    Json schema;
    schema["description"] = stage.info.summary + (stage.info.reference.empty() ? "" : " " + stage.info.reference);
    schema["type"] = {"object", "null"};
    if (stage.kind == StageKind::writer) {
        Json file = {{"description", "File to write, relative to the run's folder."},
                     {"type", "string"},
                     {"pattern", "^(?!/)(?!(.*/)?\\.\\.(/|$))[^\\\\]*[^/\\\\]$"}};
        if (stage.info.extensions.empty()) {
            schema["type"] = "object";
            schema["required"] = {"file"};
        }
        properties["file"] = std::move(file);
    }
    if (can_be_isolated(stage.kind)) {
        add_isolation(properties);
    }
    schema["properties"] = std::move(properties);
    schema["additionalProperties"] = false;
    return schema;
}

/// Returns the schema of "stage" or {stage: {parameters}}, for the given kinds.
Json stage_item(const Registry& registry, std::initializer_list<StageKind> kinds) {
    Json names = Json::array(), properties = Json::object();
    for (const auto& [name, stage] : registry.stages()) {
        if (std::find(kinds.begin(), kinds.end(), stage.kind) != kinds.end()) {
            if (stage.kind != StageKind::writer || !stage.info.extensions.empty()) {
                names.push_back(name);
            }
            properties[name] = reference(name);
        }
    }
    Json map = object(std::move(properties));
    map["minProperties"] = 1;
    map["maxProperties"] = 1;
    Json alternatives = Json::array({std::move(map)});
    if (!names.empty()) {
        alternatives.push_back({{"enum", std::move(names)}});
    }
    return {{"anyOf", std::move(alternatives)}};
}

Json clip_schema() {
    Json properties;
    properties["normal"] = {{"description", "Direction into the restricted half-space, in the link's frame."},
                            {"type", "array"},
                            {"items", {{"type", "number"}}},
                            {"minItems", 3},
                            {"maxItems", 3},
                            {"not", {{"const", {0, 0, 0}}}}};
    properties.update(properties_of(clip_values()));
    Json plane = object(std::move(properties));
    plane["required"] = {"normal", "reach"};
    return {{"description", "Half-space constraints: planes beyond which the spheres of these links extend by at most "
                            "`reach`, such as a mounting plane."},
            {"type", "array"},
            {"items", std::move(plane)}};
}

Json keep_schema() {
    return {{"description", "Spheres [x, y, z, radius] that these links keep as they are, m, in the link's frame; they "
                            "count as spheres of the link. The others cover what these leave uncovered."},
            {"type", "array"},
            {"items", {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 4}, {"maxItems", 4}}}};
}

Json link_schema(const Registry& registry) {
    Json properties = properties_of(declarations_of(link_keys()));
    properties["clip"] = clip_schema();
    properties["keep"] = keep_schema();
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::mesh_filter || stage.kind == StageKind::spherizer ||
            stage.kind == StageKind::refiner) {
            properties[name] = reference(name);
        }
    }
    return object(std::move(properties));
}

Json loader_schema(const Registry& registry) {
    Json names = Json::array(), parameters = Json::object();
    for (const auto& [name, stage] : registry.stages()) {
        if (stage.kind == StageKind::mesh_loader || stage.kind == StageKind::robot_loader) {
            names.push_back(name);
            parameters[name] = reference(name);
        }
    }
    Json properties;
    properties["prefer"] = {
        {"description", "Loader that reads a file if several read its ending; absent: load.mesh rather than load.assimp."},
        {"enum", std::move(names)}};
    properties.update(parameters);
    Json schema = object(std::move(properties));
    schema["description"] = "Parameters of loaders; the file extension selects the loader.";
    return schema;
}

Json texts(const char* description) {
    const Json text = {{"type", "string"}, {"minLength", 1}};
    return {{"description", description},
            {"anyOf", Json::array({text, {{"type", "array"}, {"items", text}, {"minItems", 1}}})}};
}

Json snapshot_schema() {
    const Json pixels = {{"type", "integer"}, {"minimum", smallest_picture}, {"maximum", largest_picture}};
    Json properties;
    properties["size"] = {{"description", "Width and height of the robot's picture in pixels."},
                          {"type", "array"},
                          {"items", pixels},
                          {"minItems", 2},
                          {"maxItems", 2},
                          {"default", {1280, 960}}};
    properties["pose"] = {
        {"description", "Joint values of the robot's picture, rad or m; joints not named are at zero."},
        {"type", "object"},
        {"additionalProperties", {{"type", "number"}}}};
    properties["renderer"] = reference("renderer");
    return {{"description", "A picture of the robot with its spheres; debug: {snapshots: true} adds pictures of links."},
            {"anyOf", Json::array({{{"type", "boolean"}}, object(std::move(properties))})},
            {"default", false}};
}

/// Returns the schema for keys that are paths. Some keys cannot be changed by path.
Json paths_without(const std::string& fixed) {
    return {{"pattern", "^[^.]+(\\.[^.]+)*$"}, {"not", {{"pattern", "^(" + fixed + ")(\\.|$)"}}}};
}

/// Returns the schema of a map from paths to values, as in `set` and in variants.
Json changes(const char* description) {
    return {{"description", description},
            {"type", "object"},
            {"propertyNames", paths_without("foam|name|extends|set|variants|plugins")}};
}

Json top_level(const Registry& registry) {
    Json p;
    p["foam"] = {{"description", "Version of the recipe format."}, {"const", format_version}};
    const Json values = properties_of(declarations_of(top_level_keys()));
    for (const auto& [key, schema] : values.items()) {
        p[key] = schema;
    }
    p["name"]["pattern"] = folder_name;
    p["seed"]["maximum"] = std::numeric_limits<std::uint64_t>::max();
    add_isolation(p);
    p["robot"] = object({{"urdf", texts("URDF files, the first that exists is used: a path relative to the recipe, "
                                        "package://PACKAGE/PATH or file:///PATH.")}});
    p["robot"]["properties"]["xacro"] =
        texts("Xacro files, in place of URDF files: the program xacro makes a URDF of the first that exists.");
    p["robot"]["properties"]["args"] = {{"description", "Arguments of the xacro file, by name."},
                                        {"type", "object"},
                                        {"additionalProperties", {{"type", {"string", "number", "boolean"}}}}};
    p["robot"]["properties"].update(schema_of_facts());
    p["robot"]["oneOf"] = {{{"required", {"urdf"}}}, {{"required", {"xacro"}}}};
    p["mesh"] = texts("Mesh files, the first that exists is used; references as for a URDF.");
    p["package_path"] = texts("Folders to look for packages in, before those of the environment; NAME=FOLDER is the "
                              "package NAME.");
    p["plugins"] = texts("Plugin files to load, relative to the recipe.");
    p["loaders"] = loader_schema(registry);
    p["stages"] = {{"description", "Mesh filters in order, then one spherizer, then refiners in order."},
                   {"type", "array"},
                   {"items", reference("chain stage")},
                   {"contains", reference("spherizer")},
                   {"minContains", 1},
                   {"maxContains", 1}};
    p["budget"] = object(properties_of(declarations_of(budget_keys())));
    p["budget"]["properties"]["costs"] = object(properties_of(declarations_of(cost_keys())));
    p["budget"]["properties"]["costs"]["description"] = "Costs of checking an element in a consumer, by kind.";
    p["self_collision"] = {
        {"description", "Prevent overlaps between the spheres of links that are not neighbours in a reference pose, "
                        "unless their geometry touches: such links get more spheres; true: the reference pose that foam finds."},
        {"anyOf", Json::array({{{"type", "boolean"}},
                               object({{"pose",
                                        {{"description", "Joint values of that pose, rad or m; joints not named are at "
                                                         "zero, or at the limit nearest to it."},
                                         {"type", "object"},
                                         {"additionalProperties", {{"type", "number"}}}}}})})},
        {"default", false}};
    p["links"] = {
        {"description", "Settings for the links that a name or glob (* ? [a-z]) matches; later entries have priority."},
        {"type", "object"},
        {"propertyNames", {{"minLength", 1}}},
        {"additionalProperties", link_schema(registry)}};
    p["outputs"] = {{"description", "Files to write; absent: NAME.urdf (robots) and NAME.json."},
                    {"type", "array"},
                    {"items", reference("writer")}};
    p["snapshots"] = snapshot_schema();
    p["debug"] = object(properties_of(declarations_of(debug_keys())));
    p["sweep"] = {
        {"description", "Values to run through: a path of keys and its values; several make all combinations."},
        {"type", "object"},
        {"minProperties", 1},
        {"propertyNames", paths_without("foam|name|plugins|sweep|extends|set|variants")},
        {"additionalProperties", {{"type", "array"}, {"minItems", 1}, {"uniqueItems", true}}}};
    p["variants"] = {{"description", "Named changes: `foam run RECIPE --variant NAME`."},
                     {"type", "object"},
                     {"propertyNames", {{"pattern", folder_name}}},
                     {"additionalProperties", changes("Paths of keys and their values in this variant.")}};
    return p;
}

Json or_null(Json schema) {
    Json result;
    if (schema.contains("description")) {
        result["description"] = schema["description"];
        schema.erase("description");
    }
    result["anyOf"] = Json::array({std::move(schema), {{"type", "null"}}});
    return result;
}

/// Returns the schema of a map that is merged into another one: no key is required, and null removes one.
Json laid_over(Json schema) {
    if (schema.contains("$ref")) {
        const std::string definition = schema["$ref"].get<std::string>().substr(std::string("#/$defs/").size());
        const bool stage = definition.find('.') != std::string::npos;
        return stage ? reference("changed " + definition) : schema;
    }
    for (const char* key : {"required", "minProperties"}) {
        schema.erase(key);
    }
    if (schema.contains("anyOf")) {
        for (Json& alternative : schema["anyOf"]) {
            alternative = laid_over(alternative);
        }
    }
    if (schema.contains("properties")) {
        for (auto& [key, value] : schema["properties"].items()) {
            value = or_null(key == "renderer" ? value : laid_over(value));
        }
    }
    if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object()) {
        schema["additionalProperties"] = or_null(laid_over(schema["additionalProperties"]));
    }
    return schema;
}

/// Returns the schema of a recipe that extends no other.
Json whole_recipe(const Registry& registry) {
    Json recipe = object(top_level(registry));
    recipe["required"] = {"foam"};
    // A sweep may set the input or the stages: only without one are they required.
    const Json one_input = {{"oneOf", Json::array({{{"required", {"robot"}}}, {{"required", {"mesh"}}}})},
                            {"required", {"stages"}}};
    recipe["anyOf"] = Json::array({{{"required", {"sweep"}}}, one_input});
    return recipe;
}

/// Returns the schema of a recipe that extends another one.
Json extending_recipe(const Registry& registry) {
    const Json keys = top_level(registry);
    Json recipe = laid_over(object(keys));
    Json& p = recipe["properties"];
    p["foam"] = keys["foam"];
    p["name"] = keys["name"];
    p["variants"] = or_null(keys["variants"]);
    p["variants"]["anyOf"][0]["additionalProperties"] = or_null(keys["variants"]["additionalProperties"]);
    p["extends"] = {{"description", "The recipe that this one extends; relative to this file."},
                    {"type", "string"},
                    {"minLength", 1}};
    p["set"] = changes("Paths of keys and their values, to change in the extended recipe.");
    recipe["required"] = {"foam", "extends"};
    return recipe;
}

} // namespace

std::string recipe_schema(const Registry& registry) {
    Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "foam recipe"}};
    schema["type"] = "object";
    schema["if"] = {{"required", {"extends"}}};
    schema["then"] = reference("extending recipe");
    schema["else"] = reference("recipe");
    Json& definitions = schema["$defs"];
    definitions["recipe"] = whole_recipe(registry);
    definitions["extending recipe"] = extending_recipe(registry);
    definitions["chain stage"] = stage_item(registry, {StageKind::mesh_filter, StageKind::spherizer, StageKind::refiner});
    definitions["spherizer"] = stage_item(registry, {StageKind::spherizer});
    definitions["renderer"] = stage_item(registry, {StageKind::renderer});
    definitions["writer"] = stage_item(registry, {StageKind::writer});
    for (const Parameter& p : isolation_values()) {
        definitions[p.name] = schema_of(p);
    }
    for (const auto& [name, stage] : registry.stages()) {
        definitions[name] = parameters_of(stage);
        if (stage.kind != StageKind::renderer && stage.kind != StageKind::writer) {
            definitions["changed " + name] = laid_over(parameters_of(stage));
        }
    }
    return schema.dump(2) + "\n";
}

} // namespace foam::recipe
