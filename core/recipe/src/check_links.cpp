// links: overrides for some links.
#include "format.hpp"

#include <foam/base/error.hpp>
#include <foam/recipe/internal/check.hpp>
#include <foam/recipe/internal/keys.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foam::inline recipe::reading {
namespace {

std::vector<std::string> chain_of(const Recipe& recipe) {
    std::vector<std::string> names;
    for (const StageCall* call : recipe.stages()) {
        if (!call->stage.empty()) { // no spherizer: an error elsewhere
            names.push_back(call->stage);
        }
    }
    return names;
}

/// Returns the isolation of the stage without overrides.
Isolation isolation_in_chain(std::string_view stage, const Recipe& recipe) {
    for (const StageCall& filter : recipe.filters) {
        if (filter.stage == stage) {
            return filter.isolation.over(recipe.isolation);
        }
    }
    return recipe.spherizer.isolation.over(recipe.isolation);
}

/// Returns whether all sets of a glob are closed. One that is not matches nothing, which is never intended.
bool is_whole_glob(std::string_view glob) {
    for (std::size_t open = glob.find('['); open != std::string_view::npos; open = glob.find('[', open + 1)) {
        const std::size_t close = glob.find(']', open + 2);
        if (close == std::string_view::npos) {
            return false;
        }
        open = close;
    }
    return true;
}

void read_stage_override(const Key& key, const Value& value, const Recipe& recipe, LinkOverride& link,
                         const Checking& checking) {
    const std::vector<std::string> chain = chain_of(recipe);
    StageItem item;
    item.name = key;
    item.call = {key.text, {}, checking.findings.locate(key.where)};
    item.parameters = value.is(Value::Kind::null) ? nullptr : &value;
    item.stage = checking.registry.find(key.text);
    if (item.stage && std::find(chain.begin(), chain.end(), key.text) == chain.end()) {
        checking.findings.error(
            key.where, "unknown-stage",
            fmt::format("stage {} is not in the chain of 'stages', so it cannot be changed for a link{}",
                        in_quotes(key.text), suggestion(key.text, chain)));
        return;
    }
    if (!item.stage) {
        std::vector<std::string> known = chain;
        for (const LinkKey& known_key : link_keys()) {
            known.push_back(known_key.declared.name);
        }
        known.insert(known.end(), {"clip", "keep"});
        checking.findings.error(
            key.where, "unknown-key",
            fmt::format("unknown key {} in link {}{}", in_quotes(key.text), link.glob, suggestion(key.text, known)));
        return;
    }
    read_stage_parameters(item, {}, checking);
    refuse_idle_limits(item, isolation_in_chain(key.text, recipe), checking.findings);
    refuse_idle_objective(item, recipe, checking.findings);
    link.stages.push_back(std::move(item.call));
}

/// Refuses a key that has no effect with the rest of the recipe.
void refuse_idle_key(const Key& key, const Recipe& recipe, Findings& findings) {
    if (key.text == "max_protrusion" && recipe.guarantee == Guarantee::inner) {
        findings.error(key.where, "conflict",
                       "spheres inside the geometry do not protrude: 'max_protrusion' has no effect with guarantee: "
                       "inner; remedy: delete it");
    } else if (key.text == "clip" && recipe.guarantee == Guarantee::inner) {
        findings.error(key.where, "conflict",
                       "spheres inside the geometry do not extend beyond it: 'clip' has no effect with guarantee: "
                       "inner; remedy: delete it");
    } else if (recipe.guarantee == Guarantee::inner && (key.text == "pad" || key.text == "keep")) {
        findings.error(key.where, "conflict",
                       fmt::format("{} may put spheres outside the geometry, which guarantee: inner does not allow; "
                                   "remedy: delete it, or guarantee: outer",
                                   in_quotes(key.text)));
    } else if (key.text == "keep" && !recipe.per_link) {
        findings.error(key.where, "conflict", "'keep' gives spheres of a whole link; remedy: per: link");
    } else if (key.text == "keep" && recipe.budget_excess) {
        findings.error(key.where, "conflict",
                       "the search for budget: {excess: …} does not see kept spheres; remedy: budget: {spheres: …}");
    } else if (key.text == "weight" && !recipe.budget_spheres && !recipe.budget_cost && !recipe.budget_excess &&
               !findings.any_error()) {
        findings.error(key.where, "conflict",
                       "'weight' is a factor in the allocation of spheres: it has no effect without budget: {spheres: "
                       "…} or {excess: …}; remedy: give a budget, or delete it");
    }
}

/// Returns the numbers of a list; nothing if it holds anything else.
std::optional<std::vector<double>> numbers_of(const Value& list) {
    std::vector<double> numbers;
    for (const Value& item : list.items) {
        if (!list.is(Value::Kind::list) || !(item.is(Value::Kind::integer) || item.is(Value::Kind::number))) {
            return std::nullopt;
        }
        numbers.push_back(item.is(Value::Kind::integer) ? static_cast<double>(item.whole) : item.real);
    }
    return numbers;
}

std::optional<Vec3> read_normal(const Value& plane, Findings& findings) {
    const Value* value = plane.find("normal");
    if (!value) {
        findings.error(plane.where, "missing-key",
                       "'normal' of 'clip' is missing; remedy: give the direction into the restricted half-space, "
                       "normal: [0, 0, -1]");
        return std::nullopt;
    }
    const auto n = numbers_of(*value);
    const Vec3 normal = n && n->size() == 3 ? Vec3{(*n)[0], (*n)[1], (*n)[2]} : Vec3{};
    if (!is_finite(normalized(normal)) || !(norm(normalized(normal)) > 0.5)) {
        findings.error(value->where, "wrong-type",
                       "'normal' of 'clip' expects three numbers, not all zero; remedy: give the direction into the "
                       "restricted half-space, normal: [0, 0, -1]");
        return std::nullopt;
    }
    return normal;
}

std::vector<ClipPlane> read_clip(const Value& planes, Findings& findings) {
    constexpr const char* example = "{normal: [0, 0, -1], reach: 0.005}";
    std::vector<ClipPlane> result;
    if (!expect_list(planes, "clip", fmt::format("clip: [{}]", example), findings)) {
        return result;
    }
    for (const Value& item : planes.items) {
        if (!expect_map(item, "clip", example, findings)) {
            continue;
        }
        const std::optional<Vec3> normal = read_normal(item, findings);
        const auto values = read_values(item, clip_values(), "clip", {"normal"}, findings);
        if (!item.find("reach")) {
            findings.error(item.where, "missing-key",
                           "'reach' of 'clip' is missing; remedy: give how far spheres may extend beyond the plane, in "
                           "m, reach: 0.005");
        }
        const auto number = [&](const char* name) {
            const auto it = values.find(name);
            return it == values.end() ? 0 : std::get<double>(it->second);
        };
        result.push_back({normal.value_or(Vec3{0, 0, -1}), number("offset"), number("reach")});
    }
    return result;
}

std::vector<Sphere> read_kept_spheres(const Value& list, Findings& findings) {
    std::vector<Sphere> spheres;
    if (!expect_list(list, "keep", "keep: [[x, y, z, radius]]", findings)) {
        return spheres;
    }
    for (const Value& item : list.items) {
        const auto n = numbers_of(item);
        const bool four = n && n->size() == 4;
        const Sphere sphere = four ? Sphere{{(*n)[0], (*n)[1], (*n)[2]}, (*n)[3]} : Sphere{};
        if (!is_finite(sphere.center) || !std::isfinite(sphere.radius) || !(sphere.radius > 0)) {
            findings.error(item.where, "wrong-type",
                           "a sphere of 'keep' is four numbers with a radius above 0; remedy: write [x, y, z, radius], "
                           "in m and in the link's frame");
        } else {
            spheres.push_back(sphere);
        }
    }
    return spheres;
}

/// Refuses keys of a link that contradict each other.
void refuse_contradictions(const LinkOverride& link, const Value& map, Findings& findings) {
    for (const char* other : {"min_spheres", "max_spheres"}) {
        if (const Key* key = map.find_key(other); key && link.spheres) {
            findings.error(key->where, "conflict",
                           fmt::format("'spheres' fixes the number: '{}' has no effect; remedy: delete one", other));
        }
    }
    const bool no_spheres = link.skip.value_or(false) || link.no_collision.value_or(false);
    for (const char* other : {"spheres", "keep", "pad"}) {
        if (const Key* key = map.find_key(other); key && no_spheres) {
            findings.error(key->where, "conflict",
                           fmt::format("these links get no spheres: '{}' has no effect; remedy: delete it", other));
        }
    }
}

LinkOverride read_override(const Key& glob, const Value& map, const Recipe& recipe, const Checking& checking) {
    LinkOverride link;
    link.glob = glob.text;
    link.where = checking.findings.locate(glob.where);
    if (glob.text.empty() || !is_whole_glob(glob.text)) {
        checking.findings.error(
            glob.where, "bad-glob",
            fmt::format("{} names no link; remedy: give a name, * and ? stand for any characters, [a-z] "
                        "for one of a set",
                        in_quotes(glob.text)));
    }
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
        const Key& key = map.keys[i];
        const auto known = std::find_if(link_keys().begin(), link_keys().end(),
                                        [&](const LinkKey& k) { return k.declared.name == key.text; });
        if (key.text == "clip") {
            refuse_idle_key(key, recipe, checking.findings);
            link.clip = read_clip(map.items[i], checking.findings);
        } else if (key.text == "keep") {
            refuse_idle_key(key, recipe, checking.findings);
            link.keep = read_kept_spheres(map.items[i], checking.findings);
        } else if (known == link_keys().end()) {
            read_stage_override(key, map.items[i], recipe, link, checking);
        } else {
            refuse_idle_key(key, recipe, checking.findings);
            if (const auto read = read_value(map.items[i], known->declared, "link " + glob.text, checking.findings)) {
                known->set(link, *read);
            }
        }
    }
    refuse_contradictions(link, map, checking.findings);
    return link;
}

} // namespace

void check_links(const Value& links, Recipe& recipe, const Checking& checking) {
    if (!expect_map(links, "links", "links: {\"*finger\": {skip: true}}", checking.findings)) {
        return;
    }
    for (std::size_t i = 0; i < links.keys.size(); ++i) {
        if (expect_map(links.items[i], links.keys[i].text, "{skip: true} or {stage.name: {parameter: value}}",
                       checking.findings)) {
            recipe.links.push_back(read_override(links.keys[i], links.items[i], recipe, checking));
        }
    }
    // Finds limits that contradict each other, where names without wildcards show it; for_link() finds the rest.
    for (const LinkOverride& link : recipe.links) {
        try {
            if (link.glob.find_first_of("*?[") == std::string::npos || (link.min_spheres && link.max_spheres)) {
                recipe.for_link(link.glob);
            }
        } catch (const Error& error) {
            const Key& key = *links.find_key(link.glob);
            checking.findings.error(key.where, "conflict", error.what());
        }
    }
}

} // namespace foam::recipe::reading
