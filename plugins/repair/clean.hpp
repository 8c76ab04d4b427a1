// Repairs without rebuilding the surface.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <optional>

namespace foam::repair {

/// The result of cleaning: indices and coordinates checked, equal vertices welded, triangles without area and repeated
/// triangles dropped. Throws Error(geometry) if the mesh is not usable: no triangle left, coordinates not finite,
/// extents out of range.
struct Cleaned {
    Mesh all;      ///< welded; triangles without area are kept
    Mesh distinct; ///< welded, no triangle without area or repeated; equal to `all` if it has as many triangles
};
Cleaned clean(const Mesh& mesh, Context& context);

/// Returns the mesh as a closed, oriented 2-manifold of positive volume, if turning triangles and splitting vertices is
/// enough. Reports the changes through the context.
std::optional<Mesh> closed_manifold(const Mesh& given, Context& context);

} // namespace foam::repair
