// What can be repaired without rebuilding the surface.
#pragma once

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <optional>

namespace foam::repair {

/// Checks indices and coordinates, welds equal vertices, drops triangles of no area and repeats of a triangle.
/// Throws Error(geometry) if the mesh is not fit for work: nothing left, coordinates not finite, extents out of range.
struct Cleaned {
    Mesh all;      ///< welded; triangles of no area are still there
    Mesh distinct; ///< welded, no triangle of no area, none twice; equal to `all` if it has as many triangles
};
Cleaned clean(const Mesh& mesh, Context& context);

/// The mesh as a closed, oriented 2-manifold of positive volume, if turning triangles and splitting vertices is enough.
/// Says through the context what was done.
std::optional<Mesh> closed_manifold(const Mesh& given, Context& context);

} // namespace foam::repair
