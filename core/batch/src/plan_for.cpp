#include "plan_for.hpp"

#include <fmt/format.h>
#include <foam/base/error.hpp>
#include <foam/sdk/kinds.hpp>

namespace foam::inline batch {
namespace {

/// Returns the recipe with a mesh that plays no part, and nothing to write but spheres.
Recipe plain_recipe(Recipe recipe) {
    recipe.mesh = {"/mesh.stl"};
    recipe.name = "mesh";
    recipe.outputs.clear();
    recipe.snapshots = recipe.debug_meshes = recipe.debug_snapshots = false;
    recipe.variant.clear();
    return recipe;
}

} // namespace

Plan plan_for(std::vector<BatchItem> items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options) {
    if (!recipe.urdf.empty()) {
        throw Error(ErrorCode::usage,
                    "the recipe is for a robot; remedy: a recipe with `mesh:`, whose file plays no part");
    }
    const StageInfo& spherizer = registry.find(recipe.spherizer.stage)->info;
    if (!spheres_alone(spherizer.kinds)) {
        throw Error(ErrorCode::usage,
                    fmt::format("the results of a batch hold spheres, and {} makes {}; remedy: a stage spherize.*, or "
                                "foam approximate for each mesh",
                                spherizer.name, words_of(spherizer.kinds)));
    }
    return open_plan(options.folder, to_yaml(plain_recipe(recipe), registry), std::move(items), options.shards);
}

std::string worker_recipe(const Recipe& recipe, const Registry& registry) {
    return to_yaml(plain_recipe(recipe), registry, true);
}

} // namespace foam::inline batch
