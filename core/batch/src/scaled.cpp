#include "scaled.hpp"

#include <foam/runtime/internal/cover.hpp>

#include <algorithm>

namespace foam::inline batch {
namespace {

/// Whether a stage has a parameter in metres that is not zero.
bool has_length(const StageCall& call, const Registry& registry) {
    const RegisteredStage* stage = registry.find(call.stage);
    if (!stage) {
        return true;
    }
    const Parameters values(stage->info.parameters, call.given);
    return std::any_of(stage->info.parameters.begin(), stage->info.parameters.end(), [&](const Parameter& parameter) {
        return parameter.unit_text.starts_with("m") && values.number(parameter.name) != 0;
    });
}

} // namespace

bool scales_freely(const Recipe& recipe, const Registry& registry) {
    const std::vector<const StageCall*> stages = recipe.stages();
    return recipe.guarantee == Guarantee::outer && recipe.links.empty() && recipe.pad.value_or(0) == 0 &&
           !recipe.budget_max_protrusion && !recipe.budget_time_limit &&
           std::none_of(stages.begin(), stages.end(),
                        [&](const StageCall* call) { return has_length(*call, registry); });
}

Recipe with_scaled_spheres(Recipe recipe, const std::vector<Sphere>& spheres, double scale, double size) {
    const DecimalGrid grid(size);
    constexpr double rounding = 1e-12; // of the size: far above that of doubles
    LinkOverride link;
    link.glob = "*";
    link.keep.emplace();
    for (const Sphere& sphere : spheres) {
        const Vec3 center = sphere.center * scale, moved = grid.nearest(center);
        link.keep->push_back({moved, grid.up(sphere.radius * scale + distance(center, moved) + rounding * size)});
    }
    recipe.links.push_back(std::move(link));
    return recipe;
}

} // namespace foam::batch
