// What commands and other languages print of recipes and stages, as JSON.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/sdk/registry.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// Returns the runs, variants and findings of a recipe that was read.
template <class Json> Json json_of_findings(const RecipeResult& read) {
    Json json{{"ok", read.ok()}, {"runs", Json::array()}, {"variants", read.variants}, {"findings", Json::array()}};
    for (const Recipe& recipe : read.recipes) {
        json["runs"].push_back(recipe.name);
    }
    for (const Diagnostic& finding : read.diagnostics) {
        json["findings"].push_back({{"severity", finding.level == Diagnostic::Level::error ? "error" : "warning"},
                                    {"code", finding.code},
                                    {"file", finding.where.file},
                                    {"line", finding.where.line},
                                    {"column", finding.where.column},
                                    {"message", finding.message}});
    }
    return json;
}

template <class Json> Json json_of_value(const ParameterValue& value) {
    return std::visit([](const auto& v) { return Json(v); }, value);
}

template <class Json> Json json_of_parameter(const Parameter& p) {
    Json json{{"name", p.name},
              {"type", to_string(p.type)},
              {"default", json_of_value<Json>(p.default_value)},
              {"doc", p.doc_text}};
    if (!p.unit_text.empty()) {
        json["unit"] = p.unit_text;
    }
    if (p.low) {
        json["low"] = *p.low;
    }
    if (p.high) {
        json["high"] = *p.high;
    }
    if (!p.choices.empty()) {
        json["choices"] = p.choices;
    }
    if (!p.source_text.empty()) {
        json["source"] = p.source_text;
    }
    json["affects_output"] = p.affects_output;
    return json;
}

/// What the stage leaves to the recipe is left out.
template <class Json> Json json_of_isolation(const Isolation& isolation) {
    Json json = Json::object();
    if (isolation.process) {
        json["isolate"] = *isolation.process ? "process" : "none";
    }
    if (isolation.time_limit) {
        json["time_limit_seconds"] = *isolation.time_limit;
    }
    if (isolation.memory_limit) {
        json["memory_limit_mib"] = *isolation.memory_limit;
    }
    return json;
}

/// Returns the declaration of a stage.
template <class Json> Json json_of_stage(const RegisteredStage& stage) {
    Json json{{"name", stage.info.name},
              {"kind", to_string(stage.kind)},
              {"summary", stage.info.summary},
              {"reference", stage.info.reference},
              {"revision", stage.info.revision},
              {"plugin", stage.plugin},
              {"plugin_version", stage.plugin_version},
              {"license", stage.license},
              {"extensions", stage.info.extensions},
              {"companions", stage.info.companions},
              {"original_only", stage.info.original_only},
              {"objective_parameter", stage.info.objective_parameter},
              {"isolation", json_of_isolation<Json>(stage.info.isolation)},
              {"last_resort", stage.info.last_resort},
              {"parameters", Json::array()}};
    for (const Parameter& p : stage.info.parameters) {
        json["parameters"].push_back(json_of_parameter<Json>(p));
    }
    return json;
}

/// Returns what is known of a plugin file, with the reason if it was refused.
template <class Json> Json json_of_plugin(const PluginRecord& record) {
    Json json{{"file", record.file.string()}, {"loaded", record.loaded()}, {"name", record.name},
              {"version", record.version},    {"license", record.license}, {"stages", record.stages}};
    if (!record.loaded()) {
        json["rejection"] = record.rejection;
    }
    return json;
}

} // namespace recipe
} // namespace foam
