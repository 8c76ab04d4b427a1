// What a fit makes least.
#pragma once

#include "surface_distance.hpp"
#include "symmetric_difference.hpp"

#include <foam/search/refine.hpp>

namespace foam::inline search::fitted {

/// The weighted sum of excess volume, missing volume and distances of the surface, in units³. Distances are multiplied
/// by the area of the surface. The missing volume of a thin part is next to nothing; the distances of its surface are
/// not.
class Target {
public:
    /// `start`: the spheres that the fit begins with; they show how thin the solid is for that many.
    Target(const Solid& solid, const by_spheres::Frame& frame, std::size_t count, const FitWeights& weights,
           const by_spheres::Balls& start);

    double of(const by_spheres::Balls& balls) const;
    /// Computes the derivatives by the balls. `turn`: the set of directions and of points.
    void slopes(const by_spheres::Balls& balls, std::size_t turn, std::vector<by_spheres::Slope>& result) const;
    /// Returns the growth of the sum without each ball.
    std::vector<double> uses(const by_spheres::Balls& balls) const;

    const SymmetricDifference& difference() const { return difference_; }
    const SurfaceDistance& distance() const { return distance_; }

private:
    SymmetricDifference difference_;
    SurfaceDistance distance_;
    SurfaceDistance::Weights of_distance_;
};

} // namespace foam::inline search::fitted
