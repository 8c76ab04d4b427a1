// Connectivity: the triangles at an edge, with equal or opposite directions; fans; components.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <optional>
#include <vector>

namespace foam::repair {

/// For side k of triangle i (from corner k to corner k + 1) at 3 i + k: the neighbouring triangle's side at that edge.
using Neighbours = std::vector<std::uint32_t>;

/// Returns the neighbours. Where more than two triangles meet at an edge, neighbours are those with the inside between
/// them: bodies that touch along an edge are separate. Nothing if a triangle has a vertex twice, or an edge has an odd
/// number of triangles, or more than two that do not alternately face in and out around it.
std::optional<Neighbours> neighbours(const Mesh& mesh);

/// Component numbers of the triangles, in the order of their first triangle.
struct Components {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};
Components components(const Mesh& mesh, const Neighbours& neighbours);

/// Turns triangles so that all of a component agree with its first triangle. Marks components that were turned in part
/// in `mixed`. Returns false if a component is one-sided (a Klein bottle). `neighbours` stays valid.
bool orient(Mesh& mesh, Neighbours& neighbours, const Components& components, std::vector<char>& mixed);

/// Gives every fan of triangles at a vertex its own copy of the vertex. Returns the number of vertices added.
/// Precondition: the mesh is oriented.
std::size_t split_fans(Mesh& mesh, const Neighbours& neighbours);

} // namespace foam::repair
