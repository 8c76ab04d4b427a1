// From covering spheres of a coarse solid to those of the solid itself.
#pragma once

#include "cover/measured/fine_surface.hpp"
#include "cover/measured/occupancy.hpp"

#include <foam/search/spherize.hpp>

#include <optional>

namespace foam::inline search::cover {

/// Fits spheres to a solid of many triangles, after a search on its coarse solid. Only triangles near the spheres'
/// surface decide how large the spheres must be: runs of triangles well inside one sphere are left out, and the
/// vertices of the coarse solid stand for them. The proof is about all triangles.
class FineFit {
public:
    struct Plan {
        int steps;      ///< of conditional gradients
        int resolution; ///< cells of the occupancy along the longest extent
    };
    /// `coarse`: the coarse_solid(). Both must outlive this.
    FineFit(const Solid& solid, const Solid& coarse, Effort effort);

    /// Returns spheres that cover the solid, with the proof: at most as many, each near the given one.
    Cover fitted(const std::vector<Sphere>& spheres);

private:
    /// Returns the surface outside all balls that are a little smaller, in small triangles, and the coarse vertices.
    FineSurface skin_around(const std::vector<Sphere>& spheres) const;
    const Occupancy& occupancy();

    const Solid& solid_;
    const Solid& coarse_;
    Frame frame_;
    Plan plan_;
    std::optional<Occupancy> occupancy_; ///< of the coarse solid; made on first use
};

} // namespace foam::inline search::cover
