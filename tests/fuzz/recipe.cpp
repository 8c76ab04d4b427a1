#include "promises.hpp"
#include "targets.hpp"

#include <foam/recipe/recipe.hpp>

namespace foam::fuzz {
namespace {

Registry& registry() {
    static Registry instance;
    static const bool loaded = [] {
        for (const char* name : {"/fixture_stages.so", "/fixture_defaults.so"}) {
            const PluginRecord& record = instance.load(std::string(FOAM_FUZZ_FIXTURES) + name);
            promise(record.loaded(), record.rejection);
        }
        return true;
    }();
    promise(loaded, "no stages");
    return instance;
}

std::string text_of(const RecipeResult& result) {
    std::string text;
    for (const Diagnostic& diagnostic : result.diagnostics) {
        text += diagnostic.text() + "\n";
    }
    return text;
}

} // namespace

/// Findings, never an exception; and what is written out means the same.
void read_recipe(std::string_view bytes) {
    const std::filesystem::path file = "/nowhere/fuzz.yaml";
    const RecipeResult result = parse_recipe(std::string(bytes), file, registry());
    for (const Diagnostic& diagnostic : result.diagnostics) {
        promise(!diagnostic.code.empty() && !diagnostic.message.empty(), "an empty finding");
    }
    promise(result.ok() == !result.recipes.empty() || !result.ok(), "neither a recipe nor a finding");
    if (!result.ok() || result.recipes.size() > 10) {
        return;
    }
    for (const Recipe& recipe : result.recipes) {
        const std::string written = to_yaml(recipe, registry());
        const RecipeResult again = parse_recipe(written, file, registry());
        promise(again.ok() && again.recipes.size() == 1,
                "the recipe written out is refused:\n" + text_of(again) + written);
        promise(to_yaml(again.recipes[0], registry()) == written,
                "the recipe written out means something else:\n" + written);
    }
}

} // namespace foam::fuzz
