#include "plan_for.hpp"

#include <foam/base/error.hpp>

namespace foam::inline batch {
namespace {

/// Returns the recipe as it is given to workers: with a mesh that plays no part, and nothing to write but spheres.
std::string recipe_text(Recipe recipe, const Registry& registry) {
    recipe.mesh = {"mesh.stl"};
    recipe.name = "mesh";
    recipe.outputs.clear();
    recipe.snapshots = recipe.debug_meshes = recipe.debug_snapshots = false;
    recipe.variant.clear();
    return to_yaml(recipe, registry, true);
}

} // namespace

Plan plan_for(const std::vector<BatchItem>& items, const Recipe& recipe, const Registry& registry,
              const BatchOptions& options) {
    if (!recipe.urdf.empty()) {
        throw Error(ErrorCode::usage, "the recipe is for a robot; remedy: a recipe with `mesh:`, whose file plays no part");
    }
    return open_plan(options.folder, recipe_text(recipe, registry), items, options.shards);
}

} // namespace foam::batch
