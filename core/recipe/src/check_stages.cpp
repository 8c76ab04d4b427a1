// stages: the chain of mesh filters and the spherizer.
#include "format.hpp"

#include <foam/recipe/internal/check.hpp>
#include <foam/sdk/internal/declaration.hpp>
#include <foam/sdk/kinds.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline recipe::reading {
namespace {

/// Returns the key for a stage that is not part of the chain.
std::string home_of(StageKind kind) {
    switch (kind) {
    case StageKind::mesh_filter:
        return "it belongs in 'stages', before the spherizer";
    case StageKind::spherizer:
        return "it belongs in 'stages', after the mesh filters";
    case StageKind::refiner:
        return "it belongs in 'stages', after the spherizer";
    case StageKind::writer:
        return "it belongs in 'outputs'";
    case StageKind::renderer:
        return "it belongs in 'snapshots: {renderer: …}'";
    case StageKind::model_reader:
        return "`foam evaluate`, `certify` and `compare` use it; recipes do not";
    case StageKind::mesh_loader:
    case StageKind::robot_loader:
        return "the file extension of the input selects it; its parameters belong in 'loaders'";
    }
    return "";
}

} // namespace

void report_unknown_stage(const Key& name, const Checking& checking) {
    const std::string near = name.text.size() < 200 ? checking.registry.nearest(name.text) : "";
    checking.findings.error(name.where, "unknown-stage",
                            fmt::format("unknown stage {}{}", in_quotes(name.text),
                                        near.empty()
                                            ? "; remedy: `foam stages` lists all, `foam plugins --why` says which "
                                              "plugins were not loaded"
                                            : fmt::format("; did you mean {}?", in_quotes(near))));
}

StageItem read_stage_item(const Value& item, std::string_view list, const Checking& checking) {
    StageItem result;
    if (item.is(Value::Kind::text)) {
        result.name = {item.text, item.where};
    } else if (item.is(Value::Kind::map) && item.keys.size() == 1) {
        result.name = item.keys[0];
        result.parameters = item.items[0].is(Value::Kind::null) ? nullptr : &item.items[0];
    } else {
        const bool flat = item.is(Value::Kind::map) && item.keys.size() > 1 && item.items[0].is(Value::Kind::null);
        std::string remedy = "write one '- stage: {parameter: value}' an item";
        if (flat) {
            remedy = fmt::format("indent the parameters deeper than {}", in_quotes(item.keys[0].text));
        }
        checking.findings.error(item.where, "wrong-type",
                                fmt::format("an item of '{}' is one stage, got {}; remedy: {}", list,
                                            item.is(Value::Kind::map)
                                                ? fmt::format("a map of {} keys", item.keys.size())
                                                : item.description(),
                                            remedy));
        return result;
    }
    result.call.stage = result.name.text;
    result.call.where = checking.findings.locate(result.name.where);
    result.stage = checking.registry.find(result.name.text);
    if (!result.stage) {
        report_unknown_stage(result.name, checking);
    }
    return result;
}

void read_stage_parameters(StageItem& item, const std::vector<std::string>& other_keys, const Checking& checking) {
    if (!item.parameters || !item.stage) {
        return;
    }
    const std::string& stage = item.call.stage;
    if (expect_map(*item.parameters, stage, fmt::format("{}: {{parameter: value}}", stage), checking.findings)) {
        std::vector<std::string> others = other_keys;
        if (can_be_isolated(item.stage->kind)) {
            for (const Parameter& p : isolation_values()) {
                others.push_back(p.name);
            }
            item.call.isolation = read_isolation(*item.parameters, stage, checking.findings);
        }
        item.call.given = read_values(*item.parameters, item.stage->info.parameters, stage, others, checking.findings);
    }
}

/// Refuses a refiner that does not know the elements of the spherizer.
static bool knows_elements(const StageItem& refiner, const Recipe& recipe, const Checking& checking) {
    const RegisteredStage* spherizer = checking.registry.find(recipe.spherizer.stage);
    const std::vector<Element::Kind>& known = refiner.stage->info.kinds;
    if (!spherizer || knows_all(known, spherizer->info.kinds)) {
        return true;
    }
    checking.findings.error(refiner.name.where, "wrong-kind",
                            fmt::format("{} refines {} alone, {} makes {}; remedy: delete it, or spherize.cover",
                                        in_quotes(refiner.call.stage), words_of(known),
                                        in_quotes(recipe.spherizer.stage), words_of(spherizer->info.kinds)));
    return false;
}

static void add_refiner(StageItem item, Recipe& recipe, const Checking& checking) {
    if (!knows_elements(item, recipe, checking)) {
        return;
    }
    const bool again = std::any_of(recipe.refiners.begin(), recipe.refiners.end(),
                                   [&](const StageCall& other) { return other.stage == item.call.stage; });
    if (again) {
        checking.findings.error(item.name.where, "duplicate-stage",
                                fmt::format("{} is given twice; remedy: delete one", in_quotes(item.call.stage)));
        return;
    }
    recipe.refiners.push_back(std::move(item.call));
}

void refuse_idle_objective(const StageItem& item, const Recipe& recipe, Findings& findings) {
    if (recipe.guarantee != Guarantee::fitted || !item.stage || !item.parameters ||
        !spheres_alone(item.stage->info.kinds)) {
        return;
    }
    const std::string& name = item.stage->info.objective_parameter;
    if (const Key* key = name.empty() ? nullptr : item.parameters->find_key(name)) {
        findings.error(key->where, "conflict",
                       fmt::format("'{}' of {} is what covering spheres make least: it has no effect with guarantee: "
                                   "fitted; remedy: delete it, and give weights to refine.fit, e.g. refine.fit: "
                                   "{{distance: 2}}, or max_gap",
                                   name, item.call.stage));
    }
}

void check_stages(const Value* stages, const Value& root, Recipe& recipe, const Checking& checking) {
    constexpr const char* example = "stages: [spherize.cover]";
    if (!stages) {
        checking.findings.error({root.where.source, 1, 1}, "missing-key",
                                fmt::format("'stages' is missing; remedy: write {}", example));
        return;
    }
    if (!expect_list(*stages, "stages", example, checking.findings)) {
        return;
    }
    bool unknown = false;
    for (const Value& value : stages->items) {
        StageItem item = read_stage_item(value, "stages", checking);
        read_stage_parameters(item, {}, checking);
        refuse_idle_limits(item, recipe.isolation, checking.findings);
        refuse_idle_objective(item, recipe, checking.findings);
        if (!item.stage) {
            unknown = true;
            continue;
        }
        const bool filter = item.stage->kind == StageKind::mesh_filter;
        const bool refiner = item.stage->kind == StageKind::refiner;
        const bool after_spherizer = !recipe.spherizer.stage.empty();
        const auto misplaced = [&](const std::string& why) {
            checking.findings.error(item.name.where, "wrong-kind",
                                    fmt::format("{} {}", in_quotes(item.call.stage), why));
        };
        if (!filter && !refiner && item.stage->kind != StageKind::spherizer) {
            misplaced(fmt::format("is a {}; {}", to_string(item.stage->kind), home_of(item.stage->kind)));
        } else if (refiner && !after_spherizer) {
            misplaced("is a refiner before the spherizer; remedy: move it after the spherizer");
        } else if (refiner) {
            add_refiner(std::move(item), recipe, checking);
        } else if (after_spherizer) {
            misplaced(
                filter ? fmt::format("is a mesh filter after the spherizer '{}'; remedy: move it before the spherizer",
                                     recipe.spherizer.stage)
                       : fmt::format("is a second spherizer in addition to '{}'; remedy: delete one",
                                     recipe.spherizer.stage));
        } else if (filter) {
            recipe.filters.push_back(std::move(item.call));
        } else {
            recipe.spherizer = std::move(item.call);
        }
    }
    if (recipe.spherizer.stage.empty() && !unknown) {
        checking.findings.error(stages->where, "missing-stage",
                                "the chain has no spherizer; remedy: add one as the last item, e.g. spherize.cover");
    }
}

Isolation read_isolation(const Value& map, std::string_view owner, Findings& findings) {
    Isolation isolation;
    for (const Parameter& p : isolation_values()) {
        const Value* value = map.find(p.name);
        const auto read = value ? read_value(*value, p, owner, findings) : std::nullopt;
        if (!read) {
            continue;
        }
        if (p.name == "isolate") {
            isolation.process = std::get<std::string>(*read) == "process";
        } else if (p.name == "time_limit") {
            isolation.time_limit = std::get<double>(*read);
        } else {
            isolation.memory_limit = static_cast<std::size_t>(std::get<std::int64_t>(*read));
        }
    }
    return isolation;
}

void refuse_idle_limits(const Value& map, const Isolation& effective, std::string_view owner, Findings& findings) {
    const Value* isolate = map.find("isolate");
    const bool wrong = isolate && !effective.process; // has a finding already
    if (effective.process.value_or(false) || wrong || !map.is(Value::Kind::map)) {
        return;
    }
    for (const char* limit : {"time_limit", "memory_limit"}) {
        if (const Key* key = map.find_key(limit)) {
            findings.error(key->where, "conflict",
                           fmt::format("'{}'{} needs process isolation; remedy: also write isolate: process", limit,
                                       owner.empty() ? "" : fmt::format(" of {}", owner)));
        }
    }
}

void refuse_idle_limits(const StageItem& item, const Isolation& base, Findings& findings) {
    if (item.parameters && item.stage) {
        refuse_idle_limits(*item.parameters, item.call.isolation.over(base).over(item.stage->info.isolation),
                           item.call.stage, findings);
    }
}

} // namespace foam::inline recipe::reading
