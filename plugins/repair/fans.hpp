// Connectivity: which triangles meet at an edge, in one direction or in both; fans; components.
#pragma once

#include <foam/mesh.hpp>

#include <optional>
#include <vector>

namespace foam::repair {

/// For side k of triangle i (from corner k to corner k + 1) at 3 i + k: the side of the other triangle at that edge.
using Neighbours = std::vector<std::uint32_t>;

/// Where more than two triangles meet at an edge, those are neighbours that have the inside between them: bodies that
/// touch along an edge are separate. Nothing if a triangle passes a vertex twice, or an edge has an odd number of
/// triangles, or more than two that do not face in and out by turns around it.
std::optional<Neighbours> neighbours(const Mesh& mesh);

/// Component numbers of the triangles, in the order of their first triangle.
struct Components {
    std::vector<std::uint32_t> of_triangle;
    std::size_t count = 0;
};
Components components(const Mesh& mesh, const Neighbours& neighbours);

/// Turns triangles so that all of a component agree with its first triangle. Components that had to be turned in part
/// are marked in `mixed`. False if a component is one-sided (a Klein bottle). `neighbours` stays valid.
bool orient(Mesh& mesh, Neighbours& neighbours, const Components& components, std::vector<char>& mixed);

/// Gives every fan of triangles at a vertex a vertex of its own. Returns the number of vertices added.
/// Precondition: the mesh is oriented.
std::size_t split_fans(Mesh& mesh, const Neighbours& neighbours);

} // namespace foam::repair
