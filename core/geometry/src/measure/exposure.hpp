// What of spheres lies on the surface of their union.
#pragma once

#include <foam/geometry/internal/measure_parts.hpp>
#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <span>
#include <vector>

namespace foam::inline geometry {

/// The exposed area of balls. The derivative of vol(U \ S) by a radius is the area of that ball's surface outside all
/// other balls and outside S.
class Exposure {
public:
    /// `directions`: number of Fibonacci points per ball.
    Exposure(const Solid& solid, std::size_t directions);

    /// Returns the area of ball `i` with radius `radius` outside the other balls and outside the solid, m².
    double area(std::span<const Sphere> balls, std::size_t i, double radius) const;

private:
    const Solid& solid_;
    std::vector<Vec3> directions_;
};

/// The excess volume that growth adds, with cached areas: an area is recomputed only when its own ball has changed by a
/// noticeable share. Neighbours that grow meanwhile make it an estimate, good enough for comparisons.
class GrowthCost {
public:
    GrowthCost(const Solid& solid, std::size_t count);

    /// Returns the excess volume that ball `i` adds when it grows to `radius`, m³, by the trapezoidal rule.
    double of(std::span<const Sphere> balls, std::size_t i, double radius);

private:
    struct Known {
        double radius = -1, area = 0;
    };
    double area(std::span<const Sphere> balls, std::size_t i, double radius, Known& known) const;

    Exposure exposure_;
    std::vector<Known> before_, after_;
};

struct ExposedSums {
    double area = 0;     ///< m²
    double weighted = 0; ///< distance to the solid times area, m³
    double farthest = 0; ///< m
};

Protrusion protrusion_of(std::span<const ExposedSums> parts);

} // namespace foam::inline geometry
