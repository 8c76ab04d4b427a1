// The figures of Measures, one estimator each.
#pragma once

#include <foam/geometry/internal/estimate.hpp>
#include <foam/geometry/measure.hpp>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

struct Difference {
    Estimate excess;  ///< vol(U \ S), m³
    Estimate missing; ///< vol(S \ U), m³
};

/// Estimates vol(U \ S) and vol(S \ U). They differ by vol(U) - vol(S), and the smaller one is integrated along lines.
/// `covered`: the balls contain the whole surface.
Difference volume_difference(const Solid& solid, std::span<const Sphere> balls, bool covered,
                             const MeasureOptions& options);

/// Returns the share of the surface's area that lies in the balls.
double covered_share(const Solid& solid, std::span<const Sphere> balls, const MeasureOptions& options);

struct Protrusion {
    double exposed_area = 0, max = 0, mean = 0;
};
/// Returns the largest distance of the exposed surface of each ball from the solid, m; 0 where none is outside.
std::vector<double> protrusions(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);
/// Measures the exposed surface of the balls and its distance to the solid.
Protrusion protrusion(const Solid& solid, std::span<const Sphere> balls, std::size_t directions);

} // namespace geometry
} // namespace foam
