#include "settings.hpp"

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

Json to_json(const ClipPlane& plane) {
    return {
        {"normal", {plane.normal.x, plane.normal.y, plane.normal.z}}, {"offset", plane.offset}, {"reach", plane.reach}};
}

Json to_json(const LinkOverride& link, const Registry& registry) {
    Json json{{"links", link.glob}};
    if (link.skip) {
        json["skip"] = *link.skip;
    }
    if (link.min_spheres) {
        json["min_spheres"] = *link.min_spheres;
    }
    if (link.max_spheres) {
        json["max_spheres"] = *link.max_spheres;
    }
    if (link.weight) {
        json["weight"] = *link.weight;
    }
    if (link.max_protrusion) {
        json["max_protrusion"] = *link.max_protrusion;
    }
    if (link.clip) {
        json["clip"] = Json::array();
        for (const ClipPlane& plane : *link.clip) {
            json["clip"].push_back(to_json(plane));
        }
    }
    for (const StageCall& call : link.stages) {
        json.update(to_json(call, registry, false));
    }
    return json;
}

const char* to_string(OnError policy) {
    switch (policy) {
    case OnError::stop:
        return "stop";
    case OnError::skip:
        return "skip";
    case OnError::fallback:
        return "fallback";
    }
    return "";
}

} // namespace

Json settings_of(const Recipe& recipe, const Registry& registry) {
    Json json{{"name", recipe.name}, {"seed", recipe.seed}, {"stages", Json::array()}};
    for (const StageCall& filter : recipe.filters) {
        json["stages"].push_back(to_json(filter, registry, true));
    }
    json["stages"].push_back(to_json(recipe.spherizer, registry, true));
    if (recipe.mesh_unit.given()) {
        json["unit"] = recipe.mesh_unit.unit.value_or("m");
        json["scale"] = recipe.mesh_unit.scale;
    }
    json["per"] = recipe.per_link ? "link" : "collision";
    json["budget"] = Json::object();
    if (recipe.budget_spheres) {
        json["budget"]["spheres"] = *recipe.budget_spheres;
    }
    if (recipe.budget_excess) {
        json["budget"]["excess"] = *recipe.budget_excess;
    }
    if (recipe.budget_max_protrusion) {
        json["budget"]["max_protrusion"] = *recipe.budget_max_protrusion;
    }
    json["guarantee"] = to_string(recipe.guarantee);
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
        entry.update(to_json(output.writer, registry, true));
        json["outputs"].push_back(std::move(entry));
    }
    json["on_error"] = to_string(recipe.on_error);
    return json;
}

} // namespace foam::runtime
