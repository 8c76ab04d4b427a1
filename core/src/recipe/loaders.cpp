// loaders: the parameters of what reads meshes and robots.
#include "check.hpp"

#include <fmt/format.h>

namespace foam {

std::map<std::string, ParameterValue> Recipe::loader_parameters(const std::string& stage) const {
    for (const StageCall& loader : loaders) {
        if (loader.stage == stage) {
            return loader.given;
        }
    }
    return {};
}

namespace reading {
namespace {

void check_loader(const Key& key, const Value& value, Recipe& recipe, const Checking& checking) {
    StageItem item;
    item.name = key;
    item.call = {key.text, {}, checking.findings.locate(key.where)};
    item.parameters = value.is(Value::Kind::null) ? nullptr : &value;
    item.stage = checking.registry.find(key.text);
    if (!item.stage) {
        report_unknown_stage(key, checking);
        return;
    }
    if (item.stage->kind != StageKind::mesh_loader && item.stage->kind != StageKind::robot_loader) {
        checking.findings.error(key.where, "wrong-kind",
                                fmt::format("{} is a {}, no loader", in_quotes(key.text), to_string(item.stage->kind)));
        return;
    }
    read_stage_parameters(item, {}, checking);
    recipe.loaders.push_back(std::move(item.call));
}

} // namespace

void check_loaders(const Value& loaders, Recipe& recipe, const Checking& checking) {
    if (!expect_map(loaders, "loaders", "loaders: {load.mesh: {max_triangles: 1000000}}", checking.findings)) {
        return;
    }
    for (std::size_t i = 0; i < loaders.keys.size(); ++i) {
        check_loader(loaders.keys[i], loaders.items[i], recipe, checking);
    }
}

} // namespace reading
} // namespace foam
