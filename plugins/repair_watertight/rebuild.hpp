// A closed surface around anything.
#pragma once

#include <foam/context.hpp>
#include <foam/mesh.hpp>

#include <cstddef>

namespace foam::watertight {

/// A closed, outward, 2-manifold surface around the triangles of `mesh` at the resolution of an octree of `leaves`
/// occupied cells; cavities are filled. Precondition: at least one triangle with an area.
Mesh rebuilt(const Mesh& mesh, std::size_t leaves, Context& context);

} // namespace foam::watertight
