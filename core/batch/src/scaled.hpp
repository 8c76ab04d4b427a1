// One search for all scales of a mesh.
#pragma once

#include <foam/recipe/recipe.hpp>

#include <optional>
#include <vector>

namespace foam::inline batch {

/// Returns whether the spheres of a scaled mesh are the scaled spheres, as far as the recipe says: it has no length in
/// metres, overrides no link, and its guarantee is outer. Some stages have parameters in metres.
bool scales_freely(const Recipe& recipe, const Registry& registry);

/// Returns the recipe of a scaled mesh that keeps the scaled spheres, if they cover it. `spheres`: of the mesh without
/// that scale. `size`: diagonal of the scaled mesh's box, m. Centres move to a decimal grid of about a millionth of the
/// size, and radii grow by as much, so that rounding leaves the proof as it is.
Recipe with_scaled_spheres(Recipe recipe, const std::vector<Sphere>& spheres, double scale, double size);

} // namespace foam::batch
