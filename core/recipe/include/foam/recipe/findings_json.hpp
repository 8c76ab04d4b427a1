// Findings as JSON objects, of a class such as nlohmann's.
#pragma once

#include <foam/recipe/recipe.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] recipe {

/// Returns the runs, variants and findings of a recipe that was read.
template <class Json> Json json_of_findings(const RecipeResult& read) {
    Json json{{"ok", read.ok()}, {"runs", Json::array()}, {"variants", read.variants}, {"findings", Json::array()}};
    for (const Recipe& recipe : read.recipes) {
        json["runs"].push_back(recipe.name);
    }
    for (const Diagnostic& finding : read.diagnostics) {
        json["findings"].push_back({{"severity", finding.level == Diagnostic::Level::error ? "error" : "warning"},
                                    {"code", finding.code},
                                    {"file", finding.where.file},
                                    {"line", finding.where.line},
                                    {"column", finding.where.column},
                                    {"message", finding.message}});
    }
    return json;
}

} // namespace recipe
} // namespace foam
