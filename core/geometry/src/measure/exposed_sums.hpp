// Sums over the exposed surface of one ball or element, and the figures of all of them.
#pragma once

#include <foam/geometry/internal/measure_parts.hpp>

#include <span>

namespace foam::inline geometry {

struct ExposedSums {
    double area = 0;     ///< m²
    double weighted = 0; ///< distance to the solid times area, m³
    double farthest = 0; ///< m
};

Protrusion protrusion_of(std::span<const ExposedSums> parts);

} // namespace foam::geometry
