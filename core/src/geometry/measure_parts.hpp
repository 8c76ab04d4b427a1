// The figures of Measures, one estimator each.
#pragma once

#include <foam/measure.hpp>

namespace foam::geometry {

/// A volume and its standard error, m³.
struct Estimate {
    double value = 0, error = 0;
};

struct Difference {
    Estimate excess;  ///< vol(U \ S)
    Estimate missing; ///< vol(S \ U)
};

/// vol(U \ S) and vol(S \ U), along lines.
Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options);

/// Share of the surface's area that lies in the balls.
double covered_share(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options);

struct Protrusion {
    double exposed_area = 0, max = 0, mean = 0;
};
/// The part of the balls' surface outside all other balls and outside the solid, and its distance to the solid.
Protrusion protrusion(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);

} // namespace foam::geometry
