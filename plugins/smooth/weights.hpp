// The neighbours of every vertex and their weights.
#pragma once

#include <foam/geometry/mesh.hpp>

#include <cstdint>
#include <vector>

namespace foam::smooth {

enum class Weighting {
    uniform,   ///< all neighbours alike (umbrella operator, Taubin 1995)
    cotangent, ///< (cot α + cot β) / 2 over the edge's opposite angles (Pinkall, Polthier 1993), not below 0
};

struct Neighbour {
    std::uint32_t vertex;
    double weight;
};

/// Neighbours in rows: those of vertex i are [begin[i], begin[i + 1]). The weights of a row add up to 1; a vertex
/// without triangles has no neighbours.
struct Neighbourhood {
    std::vector<std::uint32_t> begin;
    std::vector<Neighbour> neighbours;

    /// Returns the weighted mean of f over the neighbours of vertex i; f[i] itself if there are none.
    Vec3 mean(const std::vector<Vec3>& f, std::size_t i) const;
};

Neighbourhood neighbourhood(const Mesh& mesh, Weighting weighting);

} // namespace foam::smooth
