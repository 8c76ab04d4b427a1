#include <foam/recipe/internal/yaml.hpp>

#include "format.hpp"

#include <foam/recipe/internal/check.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace foam::inline recipe::reading {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t deepest = 16;

fs::path identity(const fs::path& file) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(file, error);
    return error ? file : result;
}

/// Returns whether a map is a single value, which replaces another one as a whole.
bool is_whole(std::string_view path) {
    return path.starts_with("variants.") || path == "snapshots.renderer";
}

void lay_over(Value& base, const Value& over, const std::string& path, Findings& findings) {
    for (std::size_t i = 0; i < over.keys.size(); ++i) {
        const Key& key = over.keys[i];
        const Value& value = over.items[i];
        auto found = std::find_if(base.keys.begin(), base.keys.end(), [&](const Key& k) { return k.text == key.text; });
        if (value.is(Value::Kind::null)) {
            if (found == base.keys.end()) {
                std::vector<std::string> known;
                std::transform(base.keys.begin(), base.keys.end(), std::back_inserter(known),
                               [](const Key& k) { return k.text; });
                findings.error(key.where, "nothing-to-remove",
                               fmt::format("null removes a key of the extended file, and there is no {}{}; remedy: "
                                           "correct or delete this line, or write {{}} for an empty map",
                                           in_quotes(key.text), suggestion(key.text, known)));
            }
            base.erase(key.text);
            continue;
        }
        const std::string here = path.empty() ? key.text : path + "." + key.text;
        const bool merged = value.is(Value::Kind::map) && !is_whole(here);
        if (found == base.keys.end()) {
            base.items.emplace_back().kind = merged ? Value::Kind::map : Value::Kind::null;
            found = base.keys.insert(base.keys.end(), key);
        }
        found->where = key.where;
        Value& below = base.items[static_cast<std::size_t>(found - base.keys.begin())];
        if (merged && below.is(Value::Kind::map)) {
            below.where = value.where;
            lay_over(below, value, here, findings);
        } else {
            below = value;
        }
    }
}

class Chain {
public:
    Chain(Registry& registry, std::vector<RecipeFile>& files, Findings& findings)
        : registry_(registry), files_(files), findings_(findings) {}

    /// Completes the tree of `file`. `folder`: that of `file`, relative to the recipe's.
    bool complete(Value& root, const fs::path& file, const fs::path& folder) {
        open_.push_back({identity(file), file.string()});
        const Value extends = root.find("extends") ? *root.find("extends") : Value{};
        const Value set = root.find("set") ? *root.find("set") : Value{};
        const bool extending = root.find("extends") != nullptr, setting = root.find("set") != nullptr;
        if (setting && !extending) {
            findings_.error(root.find_key("set")->where, "conflict",
                            "'set' changes values of the recipe that 'extends' names, and there is none; remedy: write "
                            "the values at their keys");
        }
        root.erase("extends");
        root.erase("set");
        if (extending) {
            std::optional<Value> base = read_base(extends, file, folder);
            if (!base) {
                return false;
            }
            base->erase("name");
            const Place where = root.where;
            lay_over(*base, root, "", findings_);
            root = std::move(*base);
            root.where = where;
        }
        load_plugins(root, open_.front().path, registry_, findings_);
        if (setting && extending && expect_map(set, "set", "set: {budget.spheres: 22}", findings_)) {
            apply_changes(
                root, read_changes(set, "'set'", {"foam", "name", "extends", "set", "variants", "plugins"}, findings_),
                registry_, findings_);
        }
        return true;
    }

private:
    struct Open {
        fs::path identity;
        std::string path;
    };

    std::optional<Value> read_base(const Value& extends, const fs::path& file, const fs::path& folder) {
        if (!extends.is(Value::Kind::text) || extends.text.empty()) {
            findings_.error(extends.where, "wrong-type",
                            fmt::format("'extends' expects a file, got {}; remedy: write extends: base.yaml",
                                        extends.description()));
            return std::nullopt;
        }
        const fs::path base = file.parent_path() / extends.text;
        if (!is_new(extends, base)) {
            return std::nullopt;
        }
        RecipeFile read{base, ""};
        if (const std::string why = read_text(base, read.text); !why.empty()) {
            findings_.error(extends.where, "cannot-read", fmt::format("{}: {}", base.string(), why));
            return std::nullopt;
        }
        const fs::path base_folder = folder / fs::path(extends.text).parent_path();
        const int source = findings_.add_file(base.string(), base_folder);
        files_.push_back(read);
        std::optional<Value> tree;
        if (check_text(read.text, source, findings_)) {
            tree = read_yaml(read.text, source, findings_);
        }
        if (tree && !expect_recipe(*tree, findings_)) {
            return std::nullopt;
        }
        if (tree) {
            check_version(*tree, findings_);
            return complete(*tree, base, base_folder) ? tree : std::nullopt;
        }
        return std::nullopt;
    }

    bool is_new(const Value& extends, const fs::path& base) {
        const auto first = std::find_if(open_.begin(), open_.end(),
                                        [&, id = identity(base)](const Open& open) { return open.identity == id; });
        if (first != open_.end()) {
            std::string circle;
            for (auto it = first; it != open_.end(); ++it) {
                circle += it->path + " -> ";
            }
            findings_.error(extends.where, "cycle",
                            fmt::format("files extend each other in a circle: {}{}; remedy: delete one 'extends'",
                                        circle, first->path));
        } else if (open_.size() >= deepest) {
            findings_.error(extends.where, "too-deep",
                            fmt::format("more than {} files extend one another; no recipe needs that", deepest));
        }
        return first == open_.end() && open_.size() < deepest;
    }

    Registry& registry_;
    std::vector<RecipeFile>& files_;
    Findings& findings_;
    std::vector<Open> open_;
};

} // namespace

bool complete_tree(Value& root, const fs::path& file, Registry& registry, std::vector<RecipeFile>& files,
                   Findings& findings) {
    return Chain(registry, files, findings).complete(root, file, {});
}

void load_plugins(const Value& root, const fs::path& file, Registry& registry, Findings& findings) {
    const Value* plugins = root.find("plugins");
    if (!plugins) {
        return;
    }
    const std::vector<Value> one = {*plugins};
    for (const Value& item : plugins->is(Value::Kind::list) ? plugins->items : one) {
        if (!item.is(Value::Kind::text) || item.text.empty()) {
            continue; // check_recipe() reports that
        }
        const PluginRecord& record = registry.load(file.parent_path() / findings.folder_of(item.where) / item.text);
        if (!record.loaded()) {
            findings.error(item.where, "plugin",
                           fmt::format("plugin {} is refused: {}", in_quotes(item.text), record.rejection));
        }
    }
}

std::vector<std::string> read_references(const Value& value, std::string_view name, Findings& findings) {
    std::vector<std::string> texts = read_texts(value, name, findings);
    const std::vector<Value> one = {value};
    const std::vector<Value>& items = value.is(Value::Kind::list) ? value.items : one;
    if (texts.size() != items.size()) {
        return texts; // there is a finding
    }
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const fs::path& folder = findings.folder_of(items[i].where);
        if (texts[i].find("://") == std::string::npos) {
            texts[i] = (folder / texts[i]).string();
        }
    }
    return texts;
}

} // namespace foam::recipe::reading
