// A closed surface around any triangles.
#pragma once

#include <foam/geometry/mesh.hpp>
#include <foam/sdk/context.hpp>

#include <cstddef>

namespace foam::repair {

struct RebuildOptions {
    std::size_t leaves = 0; ///< least number of occupied cells of the octree
    bool fill_openings =
        false; ///< the inside of a mesh with holes is solid, too, not only what flood fill cannot reach
};

/// Returns a closed, outward, 2-manifold surface around the triangles of `mesh`; cavities are filled. Precondition: at
/// least one triangle with an area.
Mesh rebuilt(const Mesh& mesh, const RebuildOptions& options, Context& context);

} // namespace foam::repair
