#include "record/record.hpp"

#include <foam/recipe/internal/keys.hpp>

namespace foam::inline runtime {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ParameterValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

/// Returns `{stage: {parameter: value}}`. An override (`defaults` false) has only the parameters that it overrides.
Json to_json(const StageCall& call, const Registry& registry, bool defaults) {
    Json values = Json::object();
    const RegisteredStage* stage = registry.find(call.stage);
    const std::vector<Parameter> none;
    for (const Parameter& declared : stage ? stage->info.parameters : none) {
        const auto given = call.given.find(declared.name);
        if (declared.affects_output && (defaults || given != call.given.end())) {
            values[declared.name] = to_json(given != call.given.end() ? given->second : declared.default_value);
        }
    }
    return Json{{call.stage, std::move(values)}};
}

Json to_json(const yaml::Value& value) {
    using Kind = yaml::Value::Kind;
    if (value.is(Kind::number)) {
        return value.real;
    }
    if (value.is(Kind::text)) {
        return value.text;
    }
    Json json = value.is(Kind::map) ? Json::object() : Json::array();
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        (value.is(Kind::map) ? json[value.keys[i].text] : json.emplace_back()) = to_json(value.items[i]);
    }
    return json;
}

Json to_json(const ClipPlane& plane) {
    return {
        {"normal", {plane.normal.x, plane.normal.y, plane.normal.z}}, {"offset", plane.offset}, {"reach", plane.reach}};
}

Json to_json(const LinkOverride& link, const Registry& registry) {
    Json json{{"links", link.glob}};
    for (const auto& [key, value] : reading::present(reading::link_keys(), link)) {
        json[key->declared.name] = to_json(value);
    }
    if (link.clip) {
        json["clip"] = Json::array();
        for (const ClipPlane& plane : *link.clip) {
            json["clip"].push_back(to_json(plane));
        }
    }
    for (const Sphere& s : link.keep.value_or(std::vector<Sphere>{})) {
        json["keep"].push_back({s.center.x, s.center.y, s.center.z, s.radius});
    }
    for (const StageCall& call : link.stages) {
        json.update(to_json(call, registry, false));
    }
    return json;
}

/// Returns the word of a top-level key.
Json word_of(const Recipe& recipe, std::string_view name) {
    return to_json(reading::value_of(name, reading::top_level_keys(), recipe).value());
}

} // namespace

Json settings_of(const Recipe& recipe, const Registry& registry) {
    Json json{{"name", recipe.name}, {"seed", recipe.seed}, {"stages", Json::array()}};
    for (const StageCall* call : recipe.stages()) {
        json["stages"].push_back(to_json(*call, registry, true));
    }
    if (recipe.mesh_unit.given()) {
        json["unit"] = recipe.mesh_unit.unit.value_or("m");
        json["scale"] = recipe.mesh_unit.scale;
    }
    json["per"] = word_of(recipe, "per");
    json["budget"] = Json::object();
    for (const auto& [key, value] : reading::present(reading::budget_keys(), recipe)) {
        if (key->affects_result) {
            json["budget"][key->declared.name] = to_json(value);
        }
    }
    for (const auto& [key, value] : reading::present(reading::cost_keys(), recipe)) {
        json["budget"]["costs"][key->declared.name] = to_json(value);
    }
    json["guarantee"] = word_of(recipe, "guarantee");
    for (const char* key : {"cover", "pad", "hollow", "covers"}) {
        if (const auto value = reading::value_of(key, reading::top_level_keys(), recipe)) {
            json[key] = to_json(*value);
        }
    }
    if (recipe.proved_numbers(registry) == Numbers::float32) {
        json["numbers"] = "float32";
    }
    if (const yaml::Value facts = reading::given_facts(recipe.facts); !facts.keys.empty()) {
        json["robot"] = to_json(facts);
    }
    if (recipe.self_collision) {
        json["self_collision"] = {{"pose", recipe.self_collision_pose}};
    }
    json["links"] = Json::array();
    for (const LinkOverride& link : recipe.links) {
        json["links"].push_back(to_json(link, registry));
    }
    json["outputs"] = Json::array();
    for (const OutputCall& output : recipe.outputs) {
        Json entry{{"file", output.file}};
        if (!output.into.empty()) {
            entry["into"] = output.into;
        }
        entry.update(to_json(output.writer, registry, true));
        json["outputs"].push_back(std::move(entry));
    }
    json["on_error"] = word_of(recipe, "on_error");
    return json;
}

} // namespace foam::runtime
