// What growing a ball costs: the volume it adds outside the solid and outside the other balls.
#pragma once

#include <foam/solid.hpp>
#include <foam/sphere.hpp>

#include <span>
#include <vector>

namespace foam::geometry {

/// The derivative of vol(U \ S) by a radius is the area of that ball's surface outside all other balls and outside S.
class Exposure {
public:
    Exposure(const Solid& solid, std::size_t directions);

    /// Area of ball `i` with radius `radius` outside the other balls and outside the solid, m².
    double area(std::span<const Sphere> balls, std::size_t i, double radius) const;
    /// Volume that ball `i` adds outside when it grows (takes away when it shrinks) from its radius to `radius`, m³.
    double change(std::span<const Sphere> balls, std::size_t i, double radius) const;

private:
    const Solid& solid_;
    std::vector<Vec3> directions_;
};

} // namespace foam::geometry
