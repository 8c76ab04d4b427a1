#include "format.hpp"

#include <foam/base/file.hpp>
#include <foam/recipe/internal/check.hpp>
#include <foam/recipe/internal/yaml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace foam::inline recipe {

bool RecipeResult::ok() const {
    return std::none_of(diagnostics.begin(), diagnostics.end(),
                        [](const Diagnostic& d) { return d.level == Diagnostic::Level::error; });
}

namespace {

using namespace reading;
namespace fs = std::filesystem;

/// Reads the values of `--set key.path=value`.
std::vector<Change> read_settings(const std::vector<Setting>& settings, Findings& findings) {
    std::vector<Change> changes;
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const auto& [path, text] = settings[i];
        const int source = findings.add_argument("--set", static_cast<int>(i) + 1);
        const Place where{source, 1, 1};
        const std::string first = path.substr(0, path.find('.'));
        if (first == "extends" || first == "set" || first == "variants") {
            findings.error(where, "bad-path", fmt::format("'{}' cannot be changed by --set", first));
            continue;
        }
        const std::optional<Value> value =
            check_text(text, source, findings) ? read_yaml(text, source, findings) : std::nullopt;
        if (value) {
            changes.push_back({path, *value, where, "--set sweep=null as well"});
        }
    }
    return changes;
}

/// Returns for each variant whether a requested name or glob matches it. Names that match none are findings.
std::vector<bool> choose_variants(const std::vector<Variant>& variants, const std::vector<std::string>& wanted,
                                  Findings& findings) {
    std::vector<std::string> names;
    for (const Variant& variant : variants) {
        names.push_back(variant.name);
    }
    std::vector<bool> chosen(variants.size(), false);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        bool found = false;
        for (std::size_t v = 0; v < names.size(); ++v) {
            const bool matches = names[v] == wanted[i] || glob_matches(wanted[i], names[v]);
            chosen[v] = chosen[v] || matches;
            found = found || matches;
        }
        if (!found) {
            const int source = findings.add_argument("--variant", static_cast<int>(i) + 1);
            findings.error({source, 1, 1}, "unknown-variant",
                           names.empty() ? "the recipe has no variants"
                                         : fmt::format("the recipe has no variant {}{}", in_quotes(wanted[i]),
                                                       suggestion(wanted[i], names)));
        }
    }
    return chosen;
}

/// Makes the runs of a recipe: of itself or of its variants, for every point of its sweep.
class Runs {
public:
    Runs(const fs::path& file, Registry& registry, Findings& findings)
        : file_(file), registry_(registry), findings_(findings) {}

    /// Adds runs. `variant`: nullptr for the recipe itself. Runs that are not chosen are only checked.
    void add(Value tree, const Variant* variant, const std::vector<Change>& settings, bool chosen) {
        if (count_ > most) {
            return;
        }
        if (variant) {
            apply_changes(tree, variant->changes, registry_, findings_);
        }
        if (chosen) {
            apply_changes(tree, settings, registry_, findings_);
            load_plugins(tree, file_, registry_, findings_);
        }
        const Place where = variant ? variant->where : tree.where;
        for (const SweepPoint& point : expand_sweep(std::move(tree), registry_, findings_)) {
            const std::string suffix = (variant ? "-" + variant->name : "") + point.suffix;
            Recipe recipe = check_recipe(point.root, file_, suffix, {registry_, findings_});
            if (!names_.insert(recipe.name).second && !findings_.any_error()) {
                findings_.error(where, "conflict",
                                fmt::format("two runs of this recipe have the name {}; remedy: rename the variant",
                                            in_quotes(recipe.name)));
            }
            recipe.variant = variant ? variant->name : "";
            if (chosen) {
                recipes.push_back(std::move(recipe));
            }
            if (++count_ > most) {
                findings_.error(
                    where, "too-many",
                    fmt::format("variants and sweep make more than {} runs; remedy: split the recipe", most));
                return;
            }
        }
    }

    std::vector<Recipe> recipes;

private:
    static constexpr std::size_t most = 1000;
    const fs::path& file_;
    Registry& registry_;
    Findings& findings_;
    std::set<std::string> names_;
    std::size_t count_ = 0;
};

struct Arguments {
    const std::vector<Setting>& settings;
    const std::vector<std::string>& variants;
};

RecipeResult read_tree(const std::string& text, const fs::path& file, Registry& registry, const Arguments& arguments,
                       Findings& findings) {
    RecipeResult result;
    std::optional<Value> root;
    if (check_text(text, 0, findings)) {
        root = read_yaml(text, 0, findings);
    }
    std::vector<RecipeFile> extended;
    if (!root || !expect_recipe(*root, findings) || !complete_tree(*root, file, registry, extended, findings)) {
        return result;
    }
    const std::vector<Variant> variants = take_variants(*root, findings);
    const std::vector<Change> settings = read_settings(arguments.settings, findings);
    const std::vector<bool> chosen = choose_variants(variants, arguments.variants, findings);
    Runs runs(file, registry, findings);
    runs.add(*root, nullptr, settings, arguments.variants.empty());
    for (std::size_t v = 0; v < variants.size(); ++v) {
        result.variants.push_back(variants[v].name);
        runs.add(*root, &variants[v], settings, chosen[v]);
    }
    for (Recipe& recipe : runs.recipes) {
        recipe.source = text;
        recipe.extended = extended;
    }
    result.recipes = std::move(runs.recipes);
    return result;
}

RecipeResult finish(RecipeResult result, Findings& findings) {
    if (findings.any_error()) {
        result.recipes.clear();
    }
    result.diagnostics = findings.take();
    return result;
}

} // namespace

RecipeResult read_recipe(const fs::path& file, Registry& registry, const std::vector<Setting>& settings,
                         const std::vector<std::string>& variants) {
    Findings findings(file.empty() ? "recipe" : file.string());
    std::string text;
    if (const std::string why = read_text(file, text); !why.empty()) {
        findings.error({}, "cannot-read", why);
        return finish({}, findings);
    }
    return finish(read_tree(text, file, registry, {settings, variants}, findings), findings);
}

RecipeResult parse_recipe(const std::string& text, const fs::path& file, Registry& registry,
                          const std::vector<Setting>& settings, const std::vector<std::string>& variants) {
    Findings findings(file.empty() ? "recipe" : file.string());
    return finish(read_tree(text, file, registry, {settings, variants}, findings), findings);
}

} // namespace foam::inline recipe

namespace foam::inline recipe::reading {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file, std::string& text) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        return "it is a folder; remedy: name the recipe file in it";
    }
    constexpr std::uintmax_t most = 1'000'000; // the limit of check_text()
    FileContents contents = read_regular_file(file, most, "check that this is a recipe");
    text = std::move(contents.bytes);
    return contents.why_not();
}

} // namespace foam::inline recipe::reading
