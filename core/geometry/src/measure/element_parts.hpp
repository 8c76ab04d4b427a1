// The figures of Measures for convex elements, one estimator each: as measure_parts.hpp has for spheres.
#pragma once

#include "measure/element_set.hpp"

#include <foam/geometry/internal/measure_parts.hpp>

namespace foam::inline geometry {

/// Returns the volume of the union, by lines of a lattice made for a box where elements overlap.
Estimate volume_of_union(const ElementSet& set, const Box& lattice);
/// Returns vol(S \ U), m³, along the solid's lines.
double missing_of(const Solid& solid, const ElementSet& set);
/// Returns the volume of a union of balls, as union_volume() for spheres alone.
double quick_union_volume(std::span<const Sphere> spheres, std::size_t directions);

/// Estimates vol(U \ S) and vol(S \ U). `covered`: the elements contain the whole surface.
Difference volume_difference(const Solid& solid, const ElementSet& set, bool covered, const MeasureOptions& options);
/// Returns the share of the surface's area that lies in the elements.
double covered_share(const Solid& solid, const ElementSet& set, const MeasureOptions& options);
/// Measures the exposed surface of the elements and its distance to the solid, by `samples` points on each.
Protrusion protrusion(const Solid& solid, const ElementSet& set, std::size_t samples);

/// Sets the ratios from the volumes.
void set_ratios(Measures& measures);

} // namespace foam::geometry
