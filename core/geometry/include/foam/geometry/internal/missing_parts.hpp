// The volume of a solid outside a union of balls, line by line.
#pragma once

#include <foam/geometry/solid.hpp>
#include <foam/geometry/sphere.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace foam {
inline namespace [[gnu::visibility("default")]] geometry {

class InsideLines;

/// The solid's lines outside a union of balls, each with its length. All balls are finite and have a radius. volume()
/// is bitwise equal to Solid::missing_volume() of the balls.
class MissingParts {
public:
    /// Without balls. The solid must outlive this.
    explicit MissingParts(const Solid& solid);

    /// Replaces the balls. Quick where few of them change: only lines through these are computed.
    void take(std::span<const Sphere> balls);
    /// Returns the volume, m³.
    double volume() const;
    /// Returns the volume if `first` is in the place of ball `i`, and `second` is one more.
    double volume_with(std::size_t i, const Sphere& first, const Sphere& second) const;

private:
    const InsideLines& lines_;
    std::vector<Sphere> balls_;
    std::vector<std::vector<std::uint32_t>> near_; ///< for each row of lines, the balls that reach it, ascending
    std::vector<std::vector<double>> lengths_;     ///< for each row and line
    std::vector<double> rows_;                     ///< their sums
};

} // namespace geometry
} // namespace foam
