#include "check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace foam {
namespace {

using namespace reading;
namespace fs = std::filesystem;

/// Applies `--set key.path=value`; the n-th one is source n.
void apply_settings(Value& root, const std::vector<Setting>& settings, const Registry& registry, Findings& findings) {
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const auto& [path, text] = settings[i];
        const Place where{static_cast<int>(i) + 1, 1, 1};
        if (const Value* sweep = root.find("sweep"); sweep && sweep->find(path)) {
            findings.error(where, "conflict",
                           fmt::format("{} is swept by the recipe; remedy: --set sweep=null as well", in_quotes(path)));
            continue;
        }
        if (!check_text(text, where.source, findings)) {
            continue;
        }
        const std::optional<Value> value = read_yaml(text, where.source, findings);
        if (!value) {
            continue;
        }
        if (const std::string why = set_by_path(root, path, *value, registry); !why.empty()) {
            findings.error(where, "bad-path", fmt::format("cannot set {}: {}", in_quotes(path), why));
        }
    }
}

/// Loads the plugins that the recipe names; they may offer the stages it uses.
void load_plugins(const Value& root, const fs::path& file, Registry& registry, Findings& findings) {
    const Value* plugins = root.find("plugins");
    if (!plugins) {
        return;
    }
    const std::vector<Value> one = {*plugins};
    for (const Value& item : plugins->is(Value::Kind::list) ? plugins->items : one) {
        if (!item.is(Value::Kind::text) || item.text.empty()) {
            continue; // check_recipe() finds that
        }
        const PluginRecord& record = registry.load(file.parent_path() / item.text);
        if (!record.loaded()) {
            findings.error(item.where, "plugin",
                           fmt::format("plugin {} is refused: {}", in_quotes(item.text), record.rejection));
        }
    }
}

std::optional<std::string> read_text(const fs::path& file, Findings& findings) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    const auto refuse = [&](const std::string& why) {
        findings.error({}, "cannot-read", why);
        return std::nullopt;
    };
    if (!fs::exists(status)) {
        return refuse("there is no such file; remedy: check the path");
    }
    if (fs::is_directory(status)) {
        return refuse("it is a folder; remedy: name the recipe file in it");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string text;
    // Devices and pipes have no size: a megabyte and a byte more is read at most, and check_text() refuses that.
    constexpr std::size_t most = 1'000'001;
    text.resize(most);
    stream.read(text.data(), static_cast<std::streamsize>(most));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    if (!stream.eof() && text.size() < most) {
        return refuse("it cannot be read; remedy: check its permissions");
    }
    return text;
}

std::vector<Recipe> read_tree(const std::string& text, const fs::path& file, Registry& registry,
                              const std::vector<Setting>& settings, Findings& findings) {
    std::optional<Value> root;
    if (check_text(text, 0, findings)) {
        root = read_yaml(text, 0, findings);
    }
    if (!root) {
        return {};
    }
    if (!root->is(Value::Kind::map)) {
        const bool empty = root->is(Value::Kind::null);
        findings.error({0, std::max(root->where.line, 1), std::max(root->where.column, 1)},
                       empty ? "empty" : "wrong-type",
                       fmt::format("{}; remedy: begin with 'foam: 1', then 'robot' and 'stages'",
                                   empty ? "the recipe is empty" : "a recipe is a map, got " + root->description()));
        return {};
    }
    apply_settings(*root, settings, registry, findings);
    load_plugins(*root, file, registry, findings);
    std::vector<Recipe> recipes;
    for (const SweepPoint& point : expand_sweep(std::move(*root), registry, findings)) {
        recipes.push_back(check_recipe(point.root, file, point.suffix, {registry, findings}));
        recipes.back().source = text;
    }
    return recipes;
}

RecipeResult finish(std::vector<Recipe> recipes, Findings& findings) {
    RecipeResult result;
    if (!findings.any_error()) {
        result.recipes = std::move(recipes);
    }
    result.diagnostics = findings.take();
    return result;
}

} // namespace

RecipeResult read_recipe(const fs::path& file, Registry& registry, const std::vector<Setting>& settings) {
    Findings findings(file.empty() ? "recipe" : file.string());
    std::vector<Recipe> recipes;
    if (const auto text = read_text(file, findings)) {
        recipes = read_tree(*text, file, registry, settings, findings);
    }
    return finish(std::move(recipes), findings);
}

RecipeResult parse_recipe(const std::string& text, const fs::path& file, Registry& registry,
                          const std::vector<Setting>& settings) {
    Findings findings(file.empty() ? "recipe" : file.string());
    std::vector<Recipe> recipes = read_tree(text, file, registry, settings, findings);
    return finish(std::move(recipes), findings);
}

} // namespace foam
