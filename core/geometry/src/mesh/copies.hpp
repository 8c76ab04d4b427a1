// Meshes that have the same triangles many times over.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <optional>

namespace foam::inline geometry {

/// Returns the mesh with each triangle once, if it has more than a thousand and most of them are copies of others: have
/// the same corners in the same sense. Else nothing. The surface is the same. O(n).
std::optional<Mesh> without_copies(const Mesh& mesh);

} // namespace foam::inline geometry
