// The figures of Measures, one estimator each.
#pragma once

#include "geometry/estimate.hpp"

#include <foam/measure.hpp>

namespace foam::geometry {

struct Difference {
    Estimate excess;  ///< vol(U \ S), m³
    Estimate missing; ///< vol(S \ U), m³
};

/// vol(U \ S) and vol(S \ U): they differ by what U and S differ by, and the smaller one is found along lines.
/// `covered`: the balls hold all of the surface.
Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, bool covered,
                             const MeasureOptions& options);

/// Share of the surface's area that lies in the balls.
double covered_share(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options);

struct Protrusion {
    double exposed_area = 0, max = 0, mean = 0;
};
/// The part of the balls' surface outside all other balls and outside the solid, and its distance to the solid.
Protrusion protrusion(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);

} // namespace foam::geometry
