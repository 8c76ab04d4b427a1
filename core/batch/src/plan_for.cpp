#include "plan_for.hpp"

#include <foam/base/error.hpp>

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

Plan plan_for(const std::vector<BatchItem>& items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options) {
    if (!recipe.urdf.empty()) {
        throw Error(ErrorCode::usage, "the recipe is for a robot; remedy: a recipe with `mesh:`, whose file plays no part");
    }
    return open_plan(options.folder, to_yaml(plain_recipe(recipe), registry), items, options.shards);
}

std::string worker_recipe(const Recipe& recipe, const Registry& registry) {
    return to_yaml(plain_recipe(recipe), registry, true);
}

} // namespace foam::batch
