#include "format.hpp"

#include <foam/recipe/internal/check.hpp>

#include <fmt/format.h>

namespace foam::inline recipe::reading {

std::vector<Change> read_changes(const Value& map, std::string_view by, std::initializer_list<const char*> fixed,
                                 Findings& findings) {
    std::vector<Change> changes;
    for (std::size_t i = 0; i < map.keys.size(); ++i) {
        const Key& key = map.keys[i];
        bool allowed = true;
        for (const std::string_view word : fixed) {
            if (key.text.starts_with(word) && (key.text.size() == word.size() || key.text[word.size()] == '.')) {
                findings.error(key.where, "bad-path", fmt::format("'{}' cannot be changed by {}", word, by));
                allowed = false;
            }
        }
        if (allowed) {
            changes.push_back({key.text, map.items[i], key.where, "sweep: null before it"});
        }
    }
    return changes;
}

void apply_changes(Value& root, const std::vector<Change>& changes, const Registry& registry, Findings& findings) {
    for (const Change& change : changes) {
        if (const Value* sweep = root.find("sweep"); sweep && sweep->find(change.path)) {
            findings.error(change.where, "conflict",
                           fmt::format("{} is swept by the recipe; remedy: {}", in_quotes(change.path), change.remedy));
        } else if (const std::string why = set_by_path(root, change.path, change.value, registry); !why.empty()) {
            findings.error(change.where, "bad-path", fmt::format("cannot set {}: {}", in_quotes(change.path), why));
        }
    }
}

std::vector<Variant> take_variants(Value& root, Findings& findings) {
    constexpr const char* example = "variants: {fine: {budget.spheres: 92}}";
    std::vector<Variant> result;
    const Value* found = root.find("variants");
    if (!found) {
        return result;
    }
    const Value variants = *found;
    root.erase("variants");
    if (!expect_map(variants, "variants", example, findings)) {
        return result;
    }
    for (std::size_t i = 0; i < variants.keys.size(); ++i) {
        const Key& key = variants.keys[i];
        const Value& changes = variants.items[i];
        if (const std::string why = why_no_folder_name(key.text); !why.empty()) {
            findings.error(key.where, "bad-name",
                           fmt::format("a variant's name is part of the name of the run's folder; {} {}",
                                       in_quotes(key.text), why));
        } else if (expect_map(changes, key.text, example, findings)) {
            result.push_back({key.text, key.where,
                              read_changes(changes, "a variant",
                                           {"foam", "name", "extends", "set", "variants", "plugins"}, findings)});
        }
    }
    return result;
}

} // namespace foam::recipe::reading
