// The volume of a union of balls, ball by ball.
#pragma once

#include <foam/sphere.hpp>

#include <optional>
#include <span>
#include <vector>

namespace foam::geometry {

/// The part of a ball's surface that no other hides, on the unit sphere: its area, and the integral of the normal over
/// it.
struct ExposedPart {
    double area = 0;
    Vec3 normal{};
};

/// A union of balls, and what each of them shows of itself. Balls that are finite and have a radius.
class UnionParts {
public:
    explicit UnionParts(std::vector<Sphere> balls);
    /// Of other balls. Those that are at the same place in the list and meet none that has changed keep their parts:
    /// the same to the bit, and quick where few are others.
    UnionParts with(std::vector<Sphere> balls) const;

    /// m³
    double volume() const;

private:
    UnionParts() = default;

    std::vector<Sphere> balls_;
    std::vector<std::optional<ExposedPart>> parts_; ///< nothing: another ball holds all of it
};

} // namespace foam::geometry
