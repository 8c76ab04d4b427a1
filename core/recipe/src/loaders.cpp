// loaders: the parameters of loaders of meshes and robots, and their priority.
#include <foam/recipe/internal/check.hpp>

#include <fmt/format.h>

namespace foam::inline recipe {

StageCall Recipe::loader_call(const std::string& stage) const {
    StageCall call{stage, {}, {}};
    for (const StageCall& loader : loaders) {
        call = loader.stage == stage ? loader : call;
    }
    call.isolation = call.isolation.over(isolation);
    return call;
}

namespace reading {
namespace {

/// Returns the loader with that name; null after a finding.
const RegisteredStage* find_loader(const Key& name, const Checking& checking) {
    const RegisteredStage* stage = checking.registry.find(name.text);
    if (!stage) {
        report_unknown_stage(name, checking);
        return nullptr;
    }
    if (stage->kind != StageKind::mesh_loader && stage->kind != StageKind::robot_loader) {
        checking.findings.error(name.where, "wrong-kind",
                                fmt::format("{} is a {}, no loader", in_quotes(name.text), to_string(stage->kind)));
        return nullptr;
    }
    return stage;
}

void check_preferred(const Value& value, Recipe& recipe, const Checking& checking) {
    if (!value.is(Value::Kind::text)) {
        checking.findings.error(value.where, "wrong-type",
                                fmt::format("'prefer' of loaders expects the name of a loader, got {}; remedy: write "
                                            "prefer: load.mesh",
                                            value.description()));
    } else if (find_loader({value.text, value.where}, checking)) {
        recipe.preferred_loader = value.text;
    }
}

void check_loader(const Key& key, const Value& value, Recipe& recipe, const Checking& checking) {
    StageItem item;
    item.name = key;
    item.call = {key.text, {}, checking.findings.locate(key.where)};
    item.parameters = value.is(Value::Kind::null) ? nullptr : &value;
    item.stage = find_loader(key, checking);
    if (!item.stage) {
        return;
    }
    read_stage_parameters(item, {}, checking);
    refuse_idle_limits(item, recipe.isolation, checking.findings);
    recipe.loaders.push_back(std::move(item.call));
}

} // namespace

void check_loaders(const Value& loaders, Recipe& recipe, const Checking& checking) {
    if (!expect_map(loaders, "loaders", "loaders: {load.mesh: {max_triangles: 1000000}}", checking.findings)) {
        return;
    }
    for (std::size_t i = 0; i < loaders.keys.size(); ++i) {
        if (loaders.keys[i].text == "prefer") {
            check_preferred(loaders.items[i], recipe, checking);
        } else {
            check_loader(loaders.keys[i], loaders.items[i], recipe, checking);
        }
    }
}

} // namespace reading
} // namespace foam::recipe
