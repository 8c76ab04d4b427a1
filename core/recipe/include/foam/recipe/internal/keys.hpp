// The keys of recipes with plain values: each is declared once, with the member that holds it. Reader, writer, schema
// and manifest come from these lists.
#pragma once

#include <foam/recipe/recipe.hpp>
#include <foam/yaml/value.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {
namespace reading {

/// A key whose value T holds.
template <class T> struct KeyOf {
    Parameter declared;
    std::function<void(T&, const ParameterValue&)> set;
    std::function<std::optional<ParameterValue>(const T&)> get; ///< nothing: the key is absent
    bool affects_result = true;                                 ///< false: it is not a setting in the manifest
};

/// A key of `links`, which LinkOverride holds and Recipe::LinkRecipe takes over.
struct LinkKey : KeyOf<LinkOverride> {
    std::function<void(const LinkOverride&, Recipe::LinkRecipe&)> merge;
};

const std::vector<KeyOf<Recipe>>& top_level_keys(); ///< name, seed, …, strict
const std::vector<KeyOf<Recipe>>& budget_keys();    ///< spheres, excess, …, without costs
const std::vector<KeyOf<Recipe>>& cost_keys();      ///< of `costs` in `budget`: sphere, capsule, …, hull_vertex
const std::vector<KeyOf<Recipe>>& debug_keys();     ///< meshes, snapshots
const std::vector<LinkKey>& link_keys();            ///< skip, spheres, …, without clip and keep

/// Returns the declarations of keys.
template <class Keys> std::vector<Parameter> declarations_of(const Keys& keys) {
    std::vector<Parameter> declared;
    for (const auto& key : keys) {
        declared.push_back(key.declared);
    }
    return declared;
}

/// Returns the keys that are present, with their values.
template <class Keys, class T>
std::vector<std::pair<const typename Keys::value_type*, ParameterValue>> present(const Keys& keys, const T& holder) {
    std::vector<std::pair<const typename Keys::value_type*, ParameterValue>> values;
    for (const auto& key : keys) {
        if (auto value = key.get(holder)) {
            values.emplace_back(&key, std::move(*value));
        }
    }
    return values;
}

/// Returns the value of one key; nothing if it is absent.
template <class Keys, class T>
std::optional<ParameterValue> value_of(std::string_view name, const Keys& keys, const T& holder) {
    for (const auto& key : keys) {
        if (key.declared.name == name) {
            return key.get(holder);
        }
    }
    return {};
}

struct FactKey {
    std::string name, doc, unit;
    std::variant<std::string RobotFacts::*, std::vector<std::string> RobotFacts::*, JointValues RobotFacts::*,
                 std::optional<double> RobotFacts::*>
        member;
};

const std::vector<FactKey>& fact_keys();

/// Returns the facts that are given, as values.
yaml::Value given_facts(const RobotFacts& facts);

} // namespace reading
} // namespace recipe
} // namespace foam
