// How a sphere model is judged. Symbols: S the solid as the URDF gives it, U the union of the spheres.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace foam {

/// The figures of one link.
struct Measures {
    std::size_t spheres = 0;  ///< spheres with a radius above 0
    double area = 0;          ///< of ∂S, m²
    double volume = 0;        ///< vol(S), m³
    double covered = 0;       ///< area of ∂S inside U / area of ∂S
    double gap = 0;           ///< max over ∂S of the distance to U, m: from above, to 0.1 %; infinite without spheres
    double excess = 0;        ///< vol(U \ S) / vol(S); infinite if vol(S) = 0 (surfaces without inside)
    double excess_error = 0;  ///< standard error of excess
    double missing = 0;       ///< vol(S \ U) / vol(S); 0 if vol(S) = 0
    double missing_error = 0; ///< standard error of missing
    double exposed_area = 0;  ///< of ∂U outside S, m²
    double protrusion_max = 0;                                ///< distance from the exposed surface of U to S, m
    double protrusion_mean = 0;                               ///< area-weighted mean of it, m
    bool certified = false;                                   ///< gap = 0 is proved
    double excess_volume = 0;                                 ///< vol(U \ S), m³
    double missing_volume = 0;                                ///< vol(S \ U), m³
    double excess_volume_error = 0, missing_volume_error = 0; ///< standard errors, m³
    double volume_error = 0;                                  ///< standard error of volume, m³; 0 where it is exact
};

struct MeasureOptions {
    std::uint64_t seed = 0;
    std::size_t surface_points = 100'000;
    /// Lines along which the smaller one of vol(U \ S) and vol(S \ U) is found, exact along them; the other follows
    /// from vol(U) and vol(S).
    std::size_t volume_rays = 30'000;
    /// The same where S is not closed, a line for every dozen points: into about as many pieces holes cut a line.
    std::size_t volume_points = 200'000;
    std::size_t directions_per_sphere = 1'000;
};

/// Same seed, same numbers, on any number of threads. `certified` and `gap` come from certify(). Spheres that are not
/// finite or have no radius count as absent.
Measures measure(const Solid& solid, std::span<const Sphere> spheres, const MeasureOptions& options = {});
/// Over a robot: counts and volumes add up, gap and protrusion_max are maxima, covered and protrusion_mean are weighted
/// by area, certified holds for all.
Measures total(std::span<const Measures> links);

/// Volume of the union of balls by the divergence theorem over their exposed surfaces, `directions` Fibonacci points a
/// ball; relative error about 1/directions. O(n² · directions) at worst.
double union_volume(std::span<const Sphere> spheres, std::size_t directions = 1'000);

/// A proof, or what stands in its way.
struct Certificate {
    bool holds = false;
    std::size_t pieces = 0; ///< triangles and pieces of them that were looked at
    double growth = 0;      ///< m; if it does not hold: growth of the nearest sphere that would close the worst piece
    Vec3 witness{};         ///< if it does not hold: a corner of that piece
    std::uint32_t triangle = 0; ///< if it does not hold: the triangle of Solid::surface() it lies on
};

/// Proves that every triangle of solid.surface() lies in the union of the spheres: a ball that holds the three corners
/// holds the triangle; otherwise the triangle is split and asked again, to `depth` halvings of its longest edge.
/// Rounding is on the safe side: an uncovered point never passes.
Certificate certify(const Solid& solid, std::span<const Sphere> spheres, int depth = 40);

/// Spheres grown by about the least that makes certify() hold; centres stay, and no sphere becomes smaller. Of the
/// spheres that could close a gap the one grows that adds least outside the solid; then what grew is taken back as far
/// as the others allow. `quantum` > 0: radii are rounded up to multiples of it. What is covered already stays as it is.
/// Throws Error(geometry) if no sphere is finite.
std::vector<Sphere> grown_to_cover(const Solid& solid, std::vector<Sphere> spheres, double quantum = 0);

/// The same, but spheres become smaller too: first it grows them to cover if need be, then every sphere, the one that
/// adds most outside first, shrinks to the least radius that keeps certify() true given the others, but not below what
/// fits into the solid at its centre, which adds nothing. No radius can then be made smaller on its own. A sphere
/// outside the solid that nothing needs ends with radius 0.
std::vector<Sphere> tightened_to_cover(const Solid& solid, std::vector<Sphere> spheres, double quantum = 0);

} // namespace foam
