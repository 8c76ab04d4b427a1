// Signed distances to a solid on a lattice, for questions by the million.
#pragma once

#include "cover/points.hpp"

namespace foam::cover {

/// Distances to the surface, negative inside, on a cubic lattice over the solid's bounds and somewhat beyond, all in
/// the unit frame; between the nodes they are interpolated, exact near flat faces.
class DistanceField {
public:
    /// `resolution`: cells along the longest extent of the bounds. O(resolution³ log triangles).
    DistanceField(const Solid& solid, const Frame& frame, int resolution);

    /// Beyond the lattice a bound from above: from the nearest place on it.
    float at(float x, float y, float z) const;
    /// Nodes within the solid's bounds, about `most` of them, and their distances.
    struct Nodes {
        Points places;
        std::vector<float> distance;
    };
    Nodes nodes_within_bounds(std::size_t most) const;

private:
    Vec3 place(std::size_t node) const;

    Vec3 half_{};    ///< of the bounds, which are about the origin
    float low_[3]{}; ///< first node
    float cell_ = 1; ///< distance of nodes
    int count_[3]{}; ///< nodes
    std::vector<float> distance_;
};

} // namespace foam::cover
