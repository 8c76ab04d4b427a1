// Signed distances to a solid on a lattice, for millions of queries.
#pragma once

#include "cover/measured/points.hpp"

namespace foam::inline search::cover {

/// Distances to the surface, negative inside, on a cubic lattice over the solid's bounds and slightly beyond, in the
/// unit frame. They are interpolated between the nodes, and exact near flat faces.
class DistanceField {
public:
    /// `resolution`: cells along the longest extent of the bounds. O(resolution³ log triangles).
    DistanceField(const Solid& solid, const Frame& frame, int resolution);

    /// Returns the distance. Beyond the lattice it is an upper bound, from the nearest place on it.
    float at(float x, float y, float z) const;
    /// About `most` nodes within the solid's bounds, and their distances.
    struct Nodes {
        Points places;
        std::vector<float> distance;
    };
    Nodes nodes_within_bounds(std::size_t most) const;

private:
    Vec3 place(std::size_t node) const;

    Vec3 half_{};    ///< of the bounds, which are centred at the origin
    float low_[3]{}; ///< first node
    float cell_ = 1; ///< distance of nodes
    int count_[3]{}; ///< number of nodes
    std::vector<float> distance_;
};

} // namespace foam::search::cover
